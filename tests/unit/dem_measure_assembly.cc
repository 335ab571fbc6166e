#include "dem/core/error.h"
#include "dem/measure/assembly_measures.h"
#include "tests/unit/dem_measure_contacts.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bergamo;
using namespace bergamo::dem;

TEST_CASE("an assembly's row gathers what its contacts say")
{
  const std::vector<TouchingContact> pairs = measured::random_contacts(50, 200, 0.3);
  std::vector<TouchingContact> walls;
  for (int k = 0; k < 12; ++k)
    walls.push_back(measured::contact(4 * k, -1, Vec3(0., -1., 0.2), 2. + k));
  const Particles particles = measured::unit_spheres(50);
  const AssemblyMeasures row = measure_assembly(particles, pairs, walls, 0.3, 2.);

  CHECK(row.n_contacts == 200);
  CHECK(row.coordination.mean == Approx((2. * 200. + 12.) / 50.).epsilon(1e-14));
  const CoordinationNumbers z = coordination_numbers(particles, pairs, walls);
  CHECK(row.coordination.mechanical == z.mechanical);
  CHECK(row.coordination.without_rattlers == z.without_rattlers);
  CHECK(row.coordination.n_rattlers == z.n_rattlers);
  CHECK(row.fabric == fabric_tensor(pairs));
  CHECK(row.sliding_fraction == sliding_fraction(pairs, 0.3));
  CHECK(row.mean_normal_force == mean_normal_force(pairs));
  CHECK((2. * row.stress - force_moment(pairs) - force_moment(walls)).norm() < 1e-13 * force_moment(walls).norm());

  const AssemblyMeasures periodic = measure_assembly(particles, pairs, {}, 0.3, 2.);
  CHECK(periodic.coordination.mean == 8.);
  CHECK(periodic.stress == mean_stress(pairs, 2.));
  CHECK_THROWS_AS(measure_assembly(particles, pairs, walls, 0.3, 0.), ConfigError);
}

TEST_CASE("grains that overlap by more than a fifth of their radius have diverged")
{
  CHECK_NOTHROW(check_overlap(0.2, 1., "less"));
  CHECK_THROWS_WITH(check_overlap(0.3, 0.125, "smaller steps"),
                    "the run diverged: grains overlap by 0.3 of their radius at time 0.125 s; choose smaller steps");
  CHECK_THROWS_AS(check_overlap(0.3, 0.125, "smaller steps"), RunError);
  CHECK_THROWS_AS(check_overlap(std::nan(""), 0.125, "smaller steps"), RunError);
}
