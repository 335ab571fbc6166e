#include "dem/loading/compression.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/simulation/simulation.h"

#include "tests/threads.h"
#include <algorithm>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

SimulationParameters parameters()
{
  SimulationParameters p;
  p.grain() = {1e8, 0.2, 2650.};
  p.wall() = p.grain();
  p.between_grains().friction = 0.3;
  p.with_walls().friction = 0.1;
  p.set_damping(0.5);
  p.time_step = 4e-6;
  p.contact.overlap_tolerance = 0.; // a search in every step: the geometry is as exact as that of the spheres
  return p;
}

/// A dense packing under 1 kPa of superquadrics and, every other grain, spheres.
Simulation dense_packing()
{
  std::mt19937_64 generator(3);
  const Box box{Vec3::Zero(), Vec3::Constant(6.4e-3)};
  auto shapes = draw_grains({}, 0.24 * box.volume(), generator);
  for (std::size_t i = 0; i < shapes.size(); i += 2)
    shapes[i] = {Vec3::Constant(equivalent_radius(shapes[i])), 1., 1.};
  SimulationParameters p = parameters();
  p.contact.overlap_tolerance = 1e-4;
  Simulation s(p, add_at_random(shapes, box, p.grain().density, generator()), box_walls(box));
  CompressionParameters c;
  c.largest_rate = 100.;
  c.longest_time = 10.;
  Compression compression(c);
  for (int i = 0; i < 6000 && !compression.is_finished(); ++i)
    compression.step(s);
  return s;
}

/// The grains of a packing at rest, between its walls, of which one is driven in.
/// @param exponent of what was a sphere: 1, or as near to 1 as not to be taken for a sphere
Simulation begin(const Simulation &packing, const double exponent)
{
  Particles grains;
  const Particles &p = packing.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    Superquadric shape = p.parts.shape[i];
    if (shape.is_sphere())
      shape.eps1 = shape.eps2 = exponent;
    grains.add(shape, parameters().grain().density, p.position[i], p.orientation[i]);
  }
  std::vector<PlaneWall> walls;
  for (const PlaneWall &wall : packing.walls)
  {
    walls.emplace_back();
    walls.back().point = wall.point;
    walls.back().normal = wall.normal;
  }
  walls[4].velocity = Vec3(0., 0., 15e-3); // 60 um in 1000 steps: 1 % of the height
  return Simulation(parameters(), grains, walls);
}

} // namespace

TEST_CASE("spheres move the same by their own path and as superquadrics of exponent 1 + 1e-12")
{
  const Threads one_thread(1); // a team costs more than it gains on 200 grains
  const Simulation packing = dense_packing();
  Simulation spheres = begin(packing, 1.), superquadrics = begin(packing, 1. + 1e-12);
  const std::size_t n = spheres.particles.size();
  const auto is_sphere = [](const Superquadric &shape) { return shape.is_sphere(); };
  REQUIRE(2 * std::count_if(spheres.particles.parts.shape.begin(), spheres.particles.parts.shape.end(), is_sphere) >=
          static_cast<int>(n));
  REQUIRE(
      std::none_of(superquadrics.particles.parts.shape.begin(), superquadrics.particles.parts.shape.end(), is_sphere));
  for (int i = 0; i < 1000; ++i)
  {
    spheres.step();
    superquadrics.step();
  }
  spheres.compute_forces();
  superquadrics.compute_forces();
  CHECK(spheres.contacts.sphere_sphere[0].n_touching() > 50); // else nothing was compared
  CHECK(superquadrics.contacts.sphere_sphere[0].n_touching() == 0);
  CHECK(superquadrics.contacts.n_touching() == spheres.contacts.n_touching());

  // The shapes differ by 1e-12 of a radius, 4e-16 m, searches by some 1e-16 m more. Contacts of grains that are held on
  // all sides keep such differences small; what grows them are the few loose grains, which may be hit many times by
  // factors of two: hence a short and fast run. Found from eleven packings: up to 7e-7 and 1.3e-6 of the motions (after
  // three times as many steps, at a third of the speed, up to 4e-4). A wrong term in either path would show in the
  // motion itself, at a thousandth or more of it: the bound is a hundredth of that.
  double apart = 0., turned = 0., moved = 0., rotated = 0., force = 0.;
  std::vector<double> force_errors;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Particles &a = spheres.particles, &b = superquadrics.particles;
    const auto j = superquadrics.index_of(a.id[i]);
    apart = std::max(apart, (a.position[i] - b.position[j]).norm());
    turned = std::max(turned, a.orientation[i].angularDistance(b.orientation[j]));
    moved = std::max(moved, (a.position[i] - packing.particles.position[a.id[i]]).norm());
    rotated = std::max(rotated, a.orientation[i].angularDistance(packing.particles.orientation[a.id[i]]));
    force_errors.push_back((a.force[i] - b.force[j]).norm());
    force = std::max(force, a.force[i].norm());
  }
  std::sort(force_errors.begin(), force_errors.end());
  const double median = force_errors[n / 2], of_nearly_all = force_errors[n * 19 / 20];
  CAPTURE(apart, moved, turned, rotated, median, of_nearly_all, force);
  CHECK(moved > 5e-5); // the wall was followed
  CHECK(apart < 1e-5 * moved);
  CHECK(turned < 1e-5 * rotated);
  // Not of the one or other loose grain that is just being hit: its stiff contact magnifies what is apart, and the
  // largest force of the moment may be small. A tenth of what a wrong term would make.
  CHECK(median < 1e-4 * force);
  CHECK(of_nearly_all < 1e-3 * force);

  // Sums over all grains and steps, on which single loose grains have little weight: up to 3e-8 found.
  const GrainEnergy a = spheres.energy(), b = superquadrics.energy();
  CHECK(a.friction_loss > 0.1 * a.wall_work);
  for (const auto number :
       {&GrainEnergy::kinetic, &GrainEnergy::normal, &GrainEnergy::tangential, &GrainEnergy::friction_loss,
        &GrainEnergy::viscous_loss, &GrainEnergy::curvature_work, &GrainEnergy::wall_work})
    CHECK(std::abs(a.*number - b.*number) < 1e-6 * a.wall_work);
  // Open is the turning of normals and arms within a step, the same for both paths: up to 2.2e-7 found.
  CHECK(std::abs(a.balance()) < 2e-6 * a.wall_work);
  CHECK(std::abs(b.balance()) < 2e-6 * b.wall_work);
}
