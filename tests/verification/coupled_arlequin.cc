// Grains and continuum in one overlap, moved together: the coupling must not notice.
// Source of the conditions: Wellmann, 6.1-6.2; forces are gradients of one energy of the displacement difference.

#include <catch2/catch.hpp>

#include "coupling/adapter/dealii_adapter.h"
#include "coupling/adapter/model_energy.h"
#include "coupling/adapter/stress_profile.h"
#include "dem/packing/grading.h"
#include "dem/packing/random_addition.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/verification/pressed_model.h"

#include <deal.II/grid/tria.h>
#include <omp.h>

#include <algorithm>

using namespace bergamo;
using coupling::TwoScaleModel;
using test::make_pressed_model;
using test::run;

namespace
{

constexpr double edge = 0.006, layer = 0.002; // [m]; three layers of elements, the upper one shared

/// Loose grains in the upper two thirds of a cube, elements in the lower two thirds: no contacts, so that every force
/// on a grain comes from the coupling.
TwoScaleModel make_model(const coupling::Projection projection, const double initial_pressure = 0.)
{
  std::mt19937_64 generator(7);
  const dem::Box box{Vec3(0., 0., layer), Vec3(edge, edge, 3. * layer)};
  const auto grains = dem::draw_grains(dem::GrainDistribution(), 0.2 * box.volume(), generator);
  dem::SimulationParameters parameters;
  auto simulation = std::make_unique<dem::Simulation>(parameters, dem::add_at_random(grains, box, 2650., generator()),
                                                      std::vector<dem::PlaneWall>());

  dealii::Triangulation<3> mesh;
  fe::make_box({{0., 0., 0.}, {edge, edge, 2. * layer}, {3, 3, 2}}, mesh);
  fe::ExplicitBodyParameters body;
  body.initial_stress = fe::uniform_pressure(initial_pressure);
  body.material = fe::MohrCoulomb({.cohesion = 1e9}); // elastic: what is tested is the coupling
  TwoScaleModel model(std::move(simulation), std::make_unique<fe::ExplicitBody>(mesh, body), parameters.time_step);

  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(std::clamp((x[2] - layer) / layer, 0., 1.));
  coupling::CouplingParameters join;
  join.projection = projection;
  model.join(join, weight, dem::positions_by_id(model.grains()->particles));
  model.compute_forces(); // differences count from the places here
  return model;
}

/// Displaces both models by u(X) = translation + gradient X.
void displace(TwoScaleModel &model, const Vec3 &translation, const Mat3 &gradient)
{
  for (Vec3 &x : model.grains()->particles.position)
    x += translation + gradient * x;
  const auto displacement = model.body()->displacement();
  for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
  {
    const auto &x = model.body()->node_position()[node];
    const Vec3 u = translation + gradient * Vec3(x[0], x[1], x[2]);
    for (int d = 0; d < 3; ++d)
      displacement[3 * node + d] = u[d];
  }
}

double largest_coupling_force(const TwoScaleModel &model)
{
  double largest = 0.;
  for (const auto &f : model.grains()->particles.external_force)
    largest = std::max(largest, f.norm());
  for (const double f : model.body()->external_force())
    largest = std::max(largest, std::abs(f));
  return largest;
}

} // namespace

TEST_CASE("a common translation or homogeneous strain gives no coupling force")
{
  const auto projection = GENERATE(coupling::Projection::lumped, coupling::Projection::consistent);
  Mat3 strain;
  strain << -0.01, 0.004, 0.002, 0.004, 0.006, -0.003, 0.002, -0.003, -0.012;
  const auto [translation, gradient] =
      GENERATE_COPY(std::pair(Vec3(1e-4, -2e-4, 3e-4), Mat3(Mat3::Zero())), std::pair(Vec3(0., 0., 0.), strain));
  TwoScaleModel model = make_model(projection);
  REQUIRE(model.coupling()->overlap().n_particles() > 10);

  // What the coupling would answer if the grains alone moved so: the scale for "no force".
  TwoScaleModel grains_alone = make_model(projection);
  for (Vec3 &x : grains_alone.grains()->particles.position)
    x += translation + gradient * x;
  grains_alone.compute_forces();
  const double scale = largest_coupling_force(grains_alone);
  REQUIRE(scale > 1e-3);

  displace(model, translation, gradient);
  model.compute_forces();
  // Positions of size 1e-2 m, rounded to 1e-16 of that, against displacements of 1e-5 m and more: 1e-12.
  CHECK(largest_coupling_force(model) < 1e-11 * scale);
  CHECK(model.penalty_state().energy < 1e-20 * grains_alone.penalty_state().energy);
}

TEST_CASE("coupling forces sum to zero over both models, whatever the displacements")
{
  const auto projection = GENERATE(coupling::Projection::lumped, coupling::Projection::consistent);
  TwoScaleModel model = make_model(projection);
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> uniform(-1e-5, 1e-5);
  for (Vec3 &x : model.grains()->particles.position)
    x += Vec3(uniform(generator), uniform(generator), uniform(generator));
  for (double &u : model.body()->displacement())
    u += uniform(generator);
  model.compute_forces();

  Vec3 sum = Vec3::Zero();
  double size = 0.;
  for (const auto &f : model.grains()->particles.external_force)
  {
    sum += f;
    size += f.norm();
  }
  const auto force = model.body()->external_force();
  for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
  {
    const Vec3 f(force[3 * node], force[3 * node + 1], force[3 * node + 2]);
    sum += f;
    size += f.norm();
  }
  REQUIRE(size > 1e-3);
  CHECK(sum.norm() < 1e-14 * size); // rounding of some hundred terms
}

TEST_CASE("grains that the engine has sorted have the same coupling forces, bit for bit")
{
  TwoScaleModel model = make_model(coupling::Projection::lumped), sorted = make_model(coupling::Projection::lumped);
  for (TwoScaleModel *m : {&model, &sorted})
    for (Vec3 &x : m->grains()->particles.position)
      x += 1e-3 * Vec3(x[1], -x[2], x[0]);
  sorted.grains()->sort_by_place();
  REQUIRE(sorted.grains()->particles.id != model.grains()->particles.id);
  model.compute_forces();
  sorted.compute_forces();
  const dem::Particles &p = model.grains()->particles;
  double largest = 0.;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    CHECK(sorted.grains()->particles.external_force[sorted.grains()->index_of(p.id[i])] == p.external_force[i]);
    largest = std::max(largest, p.external_force[i].norm());
  }
  CHECK(largest > 1e-3);
  CHECK(std::ranges::equal(sorted.body()->external_force(), model.body()->external_force()));
}

TEST_CASE("the coupled step keeps momentum and closes the energy balance")
{
  // No walls, no supports: the total momentum changes by rounding alone. Kinetic and coupling energy exchange without
  // loss: both leapfrogs use trapezoidal work and the penalty is quadratic, so the balance closes to rounding.
  TwoScaleModel model = make_model(coupling::Projection::lumped);
  dem::Particles &p = model.grains()->particles;
  for (Vec3 &v : p.velocity)
    v = Vec3(0.01, -0.02, -0.03);
  const auto momentum = [&]
  {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.weight[i] * p.mass[i] * p.velocity[i];
    const auto v = model.body()->velocity();
    const auto m = model.body()->mass();
    for (std::size_t k = 0; k < v.size(); ++k)
      sum[k % 3] += m[k] * v[k];
    return sum;
  };
  const auto balance = [&]
  {
    const auto e = model.body()->energy();
    return e.kinetic + e.elastic + e.plastic_dissipation + e.viscous_dissipation + model.grains()->energy().kinetic +
           model.grains()->energy().normal + model.grains()->energy().tangential +
           model.grains()->energy().friction_loss + model.grains()->energy().viscous_loss +
           model.penalty_state().energy - model.overlap()->transfer_work();
  };
  const Vec3 start = momentum();
  double first = 0., kinetic = 0.;
  for (int step = 0; step < 2000; ++step)
  {
    model.compute_forces();
    model.kick();
    if (step == 0)
    {
      first = balance();
      kinetic = model.grains()->energy().kinetic;
    }
    model.drift();
  }
  CHECK((momentum() - start).norm() < 1e-12 * start.norm());
  model.compute_forces();
  model.kick();
  CHECK(model.grains()->energy().kinetic < 0.99 * kinetic); // the continuum has been set in motion
  CHECK(std::abs(balance() - first) < 1e-4 * kinetic);      // contacts of the flying grains limit it
}

TEST_CASE("a coupled run has the same bits on any number of threads")
{
  const auto positions = [](const int n_threads)
  {
    omp_set_num_threads(n_threads);
    TwoScaleModel model = make_model(coupling::Projection::lumped, 1000.);
    for (Vec3 &v : model.grains()->particles.velocity)
      v = Vec3(0.01, -0.02, -0.05);
    for (int step = 0; step < 300; ++step)
    {
      model.compute_forces();
      model.kick();
      model.drift();
    }
    std::vector<double> state;
    for (const Vec3 &x : model.grains()->particles.position)
      state.insert(state.end(), x.data(), x.data() + 3);
    const auto u = std::as_const(*model.body()).displacement();
    state.insert(state.end(), u.begin(), u.end());
    return state;
  };
  const int default_threads = omp_get_max_threads();
  const std::vector<double> one = positions(1);
  CHECK(positions(2) == one);
  CHECK(positions(3) == one);
  omp_set_num_threads(default_threads);
}

namespace
{

/// The cube of both models.
dem::Box box_of(const TwoScaleModel &model)
{
  const auto &walls = model.grains()->walls; // without the floor
  return {Vec3(walls[0].point[0], walls[2].point[1], model.body()->node_position()[0][2]),
          Vec3(walls[1].point[0], walls[3].point[1], walls[4].point[2])};
}

/// Largest distance of a coupled grain from where it was in the packing [m].
double largest_path(const TwoScaleModel &model)
{
  double largest = 0.;
  const auto &overlap = model.coupling()->overlap();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
    largest = std::max(largest, (model.grains()->particles.position[model.grains()->index_of(overlap.particle_id[k])] -
                                 overlap.reference_position[k])
                                    .norm());
  return largest;
}

} // namespace

TEST_CASE("pressed grains of which the lower part became a continuum stay where they are")
{
  // The grains at the edge have lost what bore them. Held, they start in equilibrium, and all others with them, for
  // what the weights' gradient takes is given back: both models together bear the pressure as the grains alone did.
  // What is left is the difference of the continuum's even pressure from the packing's: p d / 2 E is 1e-7 m. Free,
  // grains at the edge fall out: the coarse motion alone is held.
  TwoScaleModel held = make_pressed_model({}), loose = make_pressed_model({.edge = {.depth = 0.}});
  REQUIRE(held.coupling()->edge().size() > 20);
  const auto force_above = [](const TwoScaleModel &model) { return model.grains()->walls[4].force[2]; };
  held.compute_forces();
  const double start = force_above(held);
  double unbalanced = 0., borne = 0.;
  for (const int coupled : held.coupling()->edge().particles())
  {
    const dem::Particles &p = held.grains()->particles;
    const auto i = held.grains()->index_of(held.coupling()->overlap().particle_id[coupled]);
    unbalanced += (p.force[i] + p.external_force[i]).norm();
    borne += p.force[i].norm();
  }
  CHECK(unbalanced <
        0.01 * borne); // dead loads for the contacts that are gone; the step since has moved grains a little
  run(held, 4000);
  run(loose, 4000);
  held.compute_forces();
  loose.compute_forces();
  const double path = largest_path(held);
  CAPTURE(path, largest_path(loose), start, force_above(held), force_above(loose));
  CHECK(path < 3e-6); // grains between loose contacts go farthest
  CHECK(largest_path(loose) > 2. * path);
  CHECK(std::abs(force_above(held) / start - 1.) < 0.03);

  // Through grains, overlap and continuum the normal stress is the force above over the area: a column at rest without
  // weight. Where grains are alone it is so exactly, by equilibrium; what may differ is the overlap of 2.4 grains.
  const dem::Box box = box_of(held);
  const std::vector<coupling::SlabStress> profile = coupling::stress_profile(held, box, 3);
  const double above = -force_above(held) * box.edges()[2] / box.volume();
  CAPTURE(above, profile[0].total()[2], profile[1].total()[2], profile[2].total()[2]);
  CHECK(profile[0].grains.norm() < 1e-4 * std::abs(above));    // but for a grain that has sunk through the edge
  CHECK(profile[2].continuum.norm() < 1e-4 * std::abs(above)); // but for the way that elements have moved
  CHECK(profile[2].total()[2] == Approx(above).epsilon(2e-3));
  CHECK(profile[1].grains[2] < 0.2 * above); // both are pressed
  CHECK(profile[1].continuum[2] < 0.2 * above);
  CHECK(coupling::unevenness(profile) < 0.05);
}

TEST_CASE("in a column under its own weight the pressure grows through the overlap as through grains alone")
{
  // Weights are shared as stresses are: w of the grains', 1 - w of the continuum's. At rest the mean normal stress of a
  // slab is the force above plus the weight of what lies over its middle; here the weight of all is half of the
  // pressure.
  const double gravity = 0.5 * test::confining_pressure / (1650. * 0.006);
  TwoScaleModel model = make_pressed_model({}, gravity);
  run(model, 8000); // 1.2 ms, some twenty times the slowest wave's period
  model.compute_forces();
  const dem::Box box = box_of(model);
  const std::vector<coupling::SlabStress> profile = coupling::stress_profile(model, box, 3); // a layer of elements each
  const double area = box.volume() / box.edges()[2], above = -model.grains()->walls[4].force[2] / area;

  std::vector<double> weight(profile.size(), 0.); // of each slab over the area [Pa]
  const double per_height = fe::density(model.body()->material()) * gravity;
  for (std::size_t k = 0; k < profile.size(); ++k)
    weight[k] = per_height * (profile[k].high - profile[k].low);
  double over = 0.;
  for (std::size_t k = profile.size(); k-- > 0;)
  {
    const double expected = above - over - 0.5 * weight[k];
    CAPTURE(k, above, profile[k].grains[2], profile[k].continuum[2]);
    CHECK(profile[k].total()[2] == Approx(expected).epsilon(0.015));
    over += weight[k];
  }
  CHECK(over > 0.4 * std::abs(above)); // it is felt
}

TEST_CASE("under pressure an overlap keeps momentum and closes its account with the work of the transfer")
{
  TwoScaleModel model = make_pressed_model({});
  run(model, 300);
  model.compute_forces();
  const dem::Particles &p = model.grains()->particles;
  REQUIRE(p.are_weighted());
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double size = 0., turning = 0., of_couples = 0.;
  const auto add = [&](const Vec3 &x, const Vec3 &f, const Vec3 &torque)
  {
    const Vec3 m = x.cross(f) + torque;
    sum += f;
    moment += m;
    size += f.norm();
    turning += m.norm();
    of_couples += torque.norm();
  };
  const auto &overlap = model.coupling()->overlap();
  for (std::size_t k = 0; k < overlap.n_particles(); ++k)
  {
    const auto i = model.grains()->index_of(overlap.particle_id[k]);
    add(overlap.reference_position[k], p.external_force[i], p.external_torque[i]);
  }
  const auto force = model.body()->external_force();
  for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
  {
    const auto &x = model.body()->node_position()[node];
    add(Vec3(x[0], x[1], x[2]), Vec3(force[3 * node], force[3 * node + 1], force[3 * node + 2]), Vec3::Zero());
  }
  REQUIRE(of_couples > 1e-3 * turning);
  CHECK(sum.norm() < 1e-13 * size); // rounding of some hundred terms
  CHECK(moment.norm() < 1e-13 * turning);

  // The upper wall presses at 1 mm/s on a packing of 6 mm and 4e8 Pa: some ten kPa in a few thousand steps.
  model.kick();
  const coupling::ModelEnergy start = coupling::energy_of(model);
  model.drift();
  model.grains()->walls[4].velocity = Vec3(0., 0., -1e-3);
  run(model, 3000);
  model.compute_forces();
  model.kick();
  const coupling::ModelEnergy end = coupling::energy_of(model);
  const double work = end.wall_work - start.wall_work;
  CAPTURE(work, end.transfer_work - start.transfer_work, end.balance() - start.balance());
  REQUIRE(work > 1e-8);
  CHECK(std::abs(end.transfer_work - start.transfer_work) > 1e-4 * work); // else the next line would see nothing of it
  CHECK(std::abs(end.balance() - start.balance()) < 1e-5 * work);
}
