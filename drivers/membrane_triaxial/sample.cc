#include "drivers/membrane_triaxial/sample.h"

#include "dem/measure/contact_list.h"
#include "dem/measure/inertial_number.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/run/measured_columns.h"

#include <algorithm>

namespace bergamo::driver
{

void SampleStart::visit(StateVisitor &visit, const std::string &name)
{
  visit(name + "/height", height);
  visit(name + "/volume", volume);
}

void CellSample::measure(const TriaxialCell &cell, const SampleStart &start, const double now, const double rate)
{
  const dem::Simulation &sample = cell.sample();
  time = now;
  height = cell.height();
  volume = cell.volume();
  axial_strain = 1. - height / start.height;
  volumetric_strain = volume / start.volume - 1.;
  pressure = cell.pressure().pressure();
  axial_stress = cell.axial_force() / cell.section();
  membrane_stress = cell.membrane_force() / cell.section();
  plate_difference = -sample.walls[lower_plate].force[2] - sample.walls[upper_plate].force[2];
  solid_fraction = dem::solid_fraction(sample.particles, volume);
  const auto pairs = sample.contacts.touching(sample.particles);
  const auto bounds = sample.contacts.touching_walls(sample.particles);
  grains =
      dem::measure_assembly(sample.particles, pairs, bounds, sample.parameters().between_grains().friction, volume);
  inertial_number = dem::inertial_number(dem::mean_grain(sample.particles), rate, pressure);
  largest_overlap = dem::largest_relative_overlap(sample.contacts, sample.particles);
  dem::check_overlap(largest_overlap, time, "a smaller time step or a smaller inertial number");
  radii = cell.radii();
  grain_energy = sample.energy();
  membrane_energy = cell.membrane().energy();
  pressure_work = cell.pressure().work();
  plate_work = sample.walls[lower_plate].work + sample.walls[upper_plate].work;
  residual.add(cell.energy_balance(), cell.work());
}

Table CellSample::table() const
{
  Table table{{{"time_s", [this] { return time; }},
               {"axial_strain", [this] { return axial_strain; }},
               {"volumetric_strain", [this] { return volumetric_strain; }},
               {"lateral_pressure_Pa", [this] { return pressure; }},
               {"axial_stress_Pa", [this] { return axial_stress; }},
               {"stress_ratio", [this] { return stress_ratio(); }},
               {"membrane_axial_stress_Pa", [this] { return membrane_stress; }},
               {"grain_axial_stress_Pa", [this] { return -grains.stress(2, 2); }},
               {"grain_lateral_stress_Pa", [this] { return lateral_stress(); }},
               {"plate_force_difference_N", [this] { return plate_difference; }},
               {"solid_fraction", [this] { return solid_fraction; }},
               {"height_m", [this] { return height; }},
               {"volume_m3", [this] { return volume; }},
               {"middle_radius_m", [this] { return radii[radii.size() / 2]; }},
               {"inertial_number", [this] { return inertial_number; }},
               {"coordination_number", [this] { return grains.coordination.mean; }},
               {"sliding_fraction", [this] { return grains.sliding_fraction; }},
               {"max_overlap_over_radius", [this] { return largest_overlap; }}}};
  table.add(columns_of(grain_energy));
  table.add({{"energy_membrane_kinetic_J", [this] { return membrane_energy.kinetic; }},
             {"energy_membrane_elastic_J", [this] { return membrane_energy.elastic; }},
             {"work_plates_J", [this] { return plate_work; }},
             {"work_pressure_J", [this] { return pressure_work; }},
             {"work_rims_J", [this] { return membrane_energy.boundary_work; }},
             {"energy_residual_J", [this] { return residual.present(); }}});
  return table;
}

Table CellSample::shape_table(const std::size_t n_rings) const
{
  Table table{{{"time_s", [this] { return time; }}, {"height_m", [this] { return height; }}}};
  for (std::size_t ring = 0; ring < n_rings; ++ring)
    table.add({{"radius_" + std::to_string(ring + 1) + "_m", [this, ring] { return radii[ring]; }}});
  return table;
}

void TestFigures::end_loading(const CellSample &s)
{
  loaded_solid_fraction = s.solid_fraction;
  loaded_coordination = s.grains.coordination.mean;
  loaded_axial = -s.grains.stress(2, 2) / s.pressure;
  loaded_lateral = s.lateral_stress() / s.pressure;
}

void TestFigures::look(const CellSample &s)
{
  if (s.stress_ratio() > peak_ratio)
  {
    peak_ratio = s.stress_ratio();
    peak_strain = s.axial_strain;
  }
  final_ratio = s.stress_ratio();
  final_strain = s.axial_strain;
  final_solid_fraction = s.solid_fraction;
  final_volumetric_strain = s.volumetric_strain;
  bulge = s.radii[s.radii.size() / 2] / s.radii.front();
  largest_overlap = std::max(largest_overlap, s.largest_overlap);
}

void TestFigures::add_to(Summary &summary) const
{
  summary.set("loaded_solid_fraction", loaded_solid_fraction);
  summary.set("loaded_coordination_number", loaded_coordination);
  summary.set("loaded_grain_axial_stress_over_pressure", loaded_axial);
  summary.set("loaded_grain_lateral_stress_over_pressure", loaded_lateral);
  summary.set("peak_stress_ratio", peak_ratio);
  summary.set("peak_strain", peak_strain);
  summary.set("final_strain", final_strain);
  summary.set("final_stress_ratio", final_ratio);
  summary.set("final_solid_fraction", final_solid_fraction);
  summary.set("final_volumetric_strain", final_volumetric_strain);
  summary.set("final_middle_radius_over_rim", bulge);
}

void TestFigures::visit(StateVisitor &visit)
{
  for (const auto &[name, value] :
       {std::pair("loaded_solid_fraction", &loaded_solid_fraction),
        std::pair("loaded_coordination", &loaded_coordination), std::pair("loaded_axial", &loaded_axial),
        std::pair("loaded_lateral", &loaded_lateral), std::pair("peak_ratio", &peak_ratio),
        std::pair("peak_strain", &peak_strain), std::pair("final_ratio", &final_ratio),
        std::pair("final_strain", &final_strain), std::pair("final_solid_fraction", &final_solid_fraction),
        std::pair("final_volumetric_strain", &final_volumetric_strain), std::pair("bulge", &bulge),
        std::pair("largest_overlap", &largest_overlap)})
    visit(std::string("figures/") + name, *value);
}

} // namespace bergamo::driver
