#include "dem/loading/cell_measures.h"

#include "dem/measure/contact_list.h"
#include "dem/measure/inertial_number.h"
#include "dem/measure/solid_fraction.h"

namespace bergamo::dem
{

CellMeasures measure_cell(const Simulation &s, const CellLoading &loading)
{
  s.check_finite();
  const std::vector<TouchingContact> contacts = s.contacts.touching(s.particles);
  const double volume = s.particles.cell.volume();
  const Vec3 rates = s.particles.cell.rate.cwiseQuotient(s.particles.cell.edges);
  CellMeasures m;
  m.time = s.time;
  m.strain = loading.strain(s);
  m.solid_fraction = solid_fraction(s.particles, volume);
  m.assembly = measure_assembly(s.particles, contacts, {}, s.parameters().between_grains().friction, volume);
  m.inertial_number =
      inertial_number(mean_grain(s.particles), rates.cwiseAbs().maxCoeff(), pressure(m.assembly.stress));
  m.rattler_fraction =
      static_cast<double>(m.assembly.coordination.n_rattlers) / static_cast<double>(s.particles.size());
  m.largest_overlap = largest_relative_overlap(contacts, s.particles);
  m.energy = s.energy();
  return m;
}

} // namespace bergamo::dem
