#include "dem/core/error.h"
#include "dem/loading/cell_measures.h"
#include "dem/measure/contact_list.h"
#include "dem/packing/pack_grains.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// A hundred grains and some that are close to one another, not yet in contact.
Simulation packed_cell()
{
  const Vec3 edges = Vec3::Constant(5e-3);
  PackingParameters packing;
  packing.solid_fraction = 0.6;
  PackedGrains packed =
      pack_grains(GrainDistribution(), PackingSpace::periodic({Vec3::Zero(), edges}), packing, /*seed*/ 1);
  packed.particles.cell = PeriodicCell(edges);
  return Simulation({}, std::move(packed.particles), {});
}

} // namespace

TEST_CASE("the measures of a cell under load agree with what else tells of them")
{
  Simulation s = packed_cell();
  const MeanGrain grain = mean_grain(s.particles);
  const double mass = std::accumulate(s.particles.mass.begin(), s.particles.mass.end(), 0.);
  LoadingStage stage;
  stage.path = LoadingPath::triaxial;
  stage.pressure = 2e5;
  stage.inertial_number = 1e-2;
  CellLoading loading(stage, grain, s.parameters().grain().density);
  loading.begin(s);
  const Vec3 start = s.particles.cell.edges;
  for (loading.prepare(s); s.contacts.n_touching() < 50 && s.n_steps < 10000; loading.prepare(s))
    s.integrate();
  const auto contacts = s.contacts.touching(s.particles);
  REQUIRE(contacts.size() >= 50);

  const CellMeasures m = measure_cell(s, loading);
  const Vec3 edges = s.particles.cell.edges;
  CHECK(m.time == s.time);
  CHECK(m.strain[2] < 0.);
  CHECK((start + start.cwiseProduct(m.strain) - edges).norm() < 1e-15 * edges.norm());
  CHECK(m.solid_fraction == Approx(mass / s.parameters().grain().density / edges.prod()).epsilon(1e-12));
  CHECK((m.assembly.stress.diagonal() - s.cell_stress()).norm() < 1e-12 * s.cell_stress().norm());
  const double rate = s.particles.cell.rate.cwiseQuotient(edges).cwiseAbs().maxCoeff();
  CHECK(strain_rate_of(grain, m.inertial_number, -s.cell_stress().mean()) == Approx(rate).epsilon(1e-12));
  const std::vector<bool> rattlers = find_rattlers(s.particles, contacts);
  CHECK(m.rattler_fraction * static_cast<double>(rattlers.size()) ==
        Approx(std::count(rattlers.begin(), rattlers.end(), true)));
  CHECK(m.assembly.n_contacts == static_cast<std::int64_t>(contacts.size()));
  CHECK(m.largest_overlap > 0.);
  CHECK(m.largest_overlap == largest_relative_overlap(s.contacts, s.particles));
  CHECK(m.energy.balance() == s.energy().balance());

  s.particles.velocity[0][0] = std::nan("");
  CHECK_THROWS_AS(measure_cell(s, loading), RunError);
}
