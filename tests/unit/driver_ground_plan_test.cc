#include "drivers/pile_installation/ground_plan.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace bergamo;
using namespace bergamo::driver;
using coupling::WeightShape;

namespace
{

/// Ground of 50 x 30 mm with a block of 20 x 16 mm, its overlap 4 mm thick.
GroundPlan plan()
{
  return {.half_width = 25e-3,
          .half_breadth = 2e-3,
          .bottom = -5e-3,
          .top = 25e-3,
          .inner_half_width = 6e-3,
          .outer_half_width = 10e-3,
          .inner_bottom = 13e-3,
          .outer_bottom = 9e-3,
          .deepest_bottom = 9e-3};
}

constexpr GroundMesh mesh{.element_size = 2e-3, .overlap_layers = 2, .layers_across = 2, .growth = 1.3};

bool has(const std::vector<double> &planes, const double place)
{
  return std::any_of(planes.begin(), planes.end(), [&](const double x) { return std::abs(x - place) < 1e-12; });
}

} // namespace

TEST_CASE("Ground plan: weights are 1 at the inner edge of the overlap, 0 at the outer one, even between", "[driver]")
{
  const GroundPlan p = plan();
  const auto w = [&](const double x, const double z) { return p.weight_at({x, 1e-3, z}, WeightShape::linear); };
  for (const double side : {-1., 1.})
  {
    CHECK(w(side * 6e-3, 20e-3) == Approx(1.));
    CHECK(w(side * 7e-3, 20e-3) == Approx(0.75));
    CHECK(w(side * 10e-3, 20e-3) == Approx(0.).margin(1e-12));
    CHECK(w(side * 20e-3, 20e-3) == 0.);
    CHECK(w(side * 2e-3, 10e-3) == Approx(0.25));
    CHECK(w(side * 7e-3, 10e-3) == Approx(0.25)); // the less of both in the corner
    CHECK(w(side * 9e-3, 12e-3) == Approx(0.25));
  }
  CHECK(w(0., 20e-3) == 1.);
  CHECK(w(0., 13e-3) == Approx(1.));
  CHECK(w(0., 9e-3) == Approx(0.).margin(1e-12));
  CHECK(w(0., 0.) == 0.);
}

TEST_CASE("Ground plan: weights have no jump, in the corners neither, and vanish where no grain is left", "[driver]")
{
  const GroundPlan p = plan();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-12e-3, 12e-3), z(6e-3, 16e-3), step(-1e-4, 1e-4);
  double greatest_beyond = 0.;
  for (int trial = 0; trial < 20000; ++trial)
  {
    const Vec3 here(x(random), 0., z(random)), there = here + Vec3(step(random), 0., step(random));
    const double w = p.weight_at(here, WeightShape::linear);
    CHECK(std::abs(w - p.weight_at(there, WeightShape::linear)) <= (here - there).norm() / 4e-3 * (1. + 1e-9));
    if (!p.holds_grain(here))
      greatest_beyond = std::max(greatest_beyond, w);
  }
  CHECK(greatest_beyond == 0.);
}

TEST_CASE("Ground plan: elements have planes at all edges of the overlap, as fine as asked for, coarser outwards",
          "[driver]")
{
  const GroundPlan p = plan();
  const fe::PitMeshParameters made = mesh_of(p, mesh);
  made.validate();
  const auto &[x, y, z] = made.planes;
  CHECK(y.size() == 3);
  for (const double place : {-25e-3, -10e-3, -8e-3, -6e-3, 6e-3, 8e-3, 10e-3, 25e-3})
    CHECK(has(x, place));
  for (const double place : {-5e-3, 9e-3, 11e-3, 13e-3, 25e-3})
    CHECK(has(z, place));
  for (std::size_t k = 0; k < x.size(); ++k)
    CHECK(x[k] == Approx(-x[x.size() - 1 - k]).margin(1e-15));
  for (const auto *planes : {&x, &z})
    for (std::size_t k = 1; k < planes->size(); ++k)
    {
      const double size = (*planes)[k] - (*planes)[k - 1];
      CHECK(size > 0.5 * mesh.element_size);
      if (planes == &x && k > 1 && x[k] > 10.1e-3) // outwards on the right
        CHECK(size <= mesh.growth * (x[k - 1] - x[k - 2]) * (1. + 1e-9));
    }
  CHECK(x.back() - x[x.size() - 2] > 1.5 * mesh.element_size);
  CHECK(made.hole_maximum[0] == 6e-3);
  CHECK(made.hole_minimum[2] == 13e-3);
}

TEST_CASE("Ground plan: a block that becomes deeper has planes for each of its bottoms, and weights exact at its edges",
          "[driver]")
{
  GroundPlan p = plan();
  p.deepest_bottom = 3e-3;
  const fe::PitMeshParameters made = mesh_of(p, mesh);
  made.validate();
  const auto &z = made.planes[2];
  for (const double place : {-5e-3, 3e-3, 5e-3, 7e-3, 9e-3, 11e-3, 13e-3, 25e-3})
    CHECK(has(z, place));
  CHECK(made.hole_minimum[2] == 13e-3); // as at the start
  for (int layer = 0; layer <= 3; ++layer)
  {
    const GroundPlan now = p.deeper(2e-3 * layer);
    for (const double place : made.planes[0])
      for (const double height : z)
      {
        const double w = now.weight_at({place, 0., height}, WeightShape::linear);
        const bool is_inside = std::abs(place) < now.inner_half_width + 1e-9 && height > now.inner_bottom - 1e-9,
                   is_outside = std::abs(place) > now.outer_half_width - 1e-9 || height < now.outer_bottom + 1e-9;
        CHECK((w == 1.) == is_inside);
        CHECK((w == 0.) == is_outside);
      }
    CHECK(now.holds_grain({0., 0., now.outer_bottom + 1e-6}));
    CHECK_FALSE(now.holds_grain({0., 0., now.outer_bottom - 1e-6}));
    CHECK(now.is_near({now.outer_half_width + 0.9e-3, 0., now.outer_bottom - 0.9e-3}, 1e-3));
    CHECK_FALSE(now.is_near({now.outer_half_width + 1.1e-3, 0., 20e-3}, 1e-3));
  }
}
