// An overlap under stress that is made anew while grains move through it: no jump of forces, a closed account, the same
// bits after a restart. Places, projection and weights are those of the present, so nothing of the motion may pile up.

#include "coupling/adapter/model_energy.h"
#include "dem/core/state.h"
#include "dem/io/snapshot.h"
#include "tests/temporary_folder.h"
#include "tests/verification/pressed_model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

using namespace bergamo;
using coupling::TwoScaleModel;

namespace
{

constexpr double speed = 0.1; // of the grains along x [m/s]

/// Renewed after a twentieth of a grain, with springs so soft that they hardly hold the grains back.
coupling::CouplingParameters soft_and_renewed(const double surface_reach = 0.)
{
  coupling::CouplingParameters join;
  join.penalty = 1e10;
  join.edge.stiffness = 1e10;
  join.renewal = 0.05;
  join.surface_reach = surface_reach;
  return join;
}

void hold_still(fe::ExplicitBody &body)
{
  std::vector<unsigned int> all(body.n_nodes());
  std::iota(all.begin(), all.end(), 0u);
  for (unsigned int d = 0; d < 3; ++d)
    body.prescribe_velocity(all, d);
}

/// The pressed cube, whose grains and walls set out along x past a continuum that rests.
TwoScaleModel make_passing_model(const double surface_reach = 0.)
{
  TwoScaleModel model = test::make_pressed_model(soft_and_renewed(surface_reach));
  hold_still(*model.body());
  for (Vec3 &v : model.grains()->particles.velocity)
    v += Vec3(speed, 0., 0.);
  for (const std::size_t wall : {0, 1})
    model.grains()->walls[wall].velocity = Vec3(speed, 0., 0.);
  return model;
}

/// Accelerations of all grains at this step, and what contacts alone would give them on average [m/s^2].
struct Accelerations
{
  std::vector<Vec3> of_grain;
  double of_contacts = 0.;

  explicit Accelerations(const dem::Particles &p)
  {
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      of_grain.push_back((p.force[i] + p.external_force[i]) / (p.weight[i] * p.mass[i]));
      of_contacts += p.force[i].norm() / (p.weight[i] * p.mass[i]) / static_cast<double>(p.size());
    }
  }

  /// Mean difference, over what contacts give.
  double jump_to(const Accelerations &next) const
  {
    double sum = 0.;
    for (std::size_t i = 0; i < of_grain.size(); ++i)
      sum += (next.of_grain[i] - of_grain[i]).norm() / static_cast<double>(of_grain.size());
    return sum / of_contacts;
  }
};

/// The cube of both models at the start.
dem::Box cube_of(const TwoScaleModel &model)
{
  const auto &walls = model.grains()->walls; // without the floor
  return {Vec3(walls[0].point[0], walls[2].point[1], model.body()->node_position()[0][2]),
          Vec3(walls[1].point[0], walls[3].point[1], walls[4].point[2])};
}

} // namespace

TEST_CASE("grains pass through an overlap under stress that is made anew, without a jump in force or energy")
{
  TwoScaleModel model = make_passing_model();
  model.compute_forces();
  model.kick();
  const coupling::ModelEnergy start = coupling::energy_of(model);
  const std::vector<std::int64_t> at_first = model.coupling()->overlap().particle_id;
  model.drift();
  double most_elastic = 0., largest_jump = 0.;
  const double diameter = model.coupling()->overlap().mean_diameter();
  const int n_steps = static_cast<int>(diameter / speed / model.grains()->parameters().time_step);
  for (int step = 0; step < n_steps; ++step)
  {
    model.compute_forces();
    if (step % 2000 == 1000)
    {
      // Made anew at the very same places: what changes is the jump.
      const Accelerations before(model.grains()->particles);
      const double stored = model.penalty_state().energy;
      model.overlap()->renew();
      model.compute_forces();
      CHECK(model.penalty_state().energy == Approx(stored).epsilon(1e-9));
      largest_jump = std::max(largest_jump, before.jump_to(Accelerations(model.grains()->particles)));
    }
    model.kick();
    most_elastic = std::max(most_elastic, coupling::energy_of(model).grains_elastic);
    model.drift();
  }
  model.compute_forces();
  model.kick();
  const coupling::ModelEnergy end = coupling::energy_of(model);
  const std::set<std::int64_t> at_last(model.coupling()->overlap().particle_id.begin(),
                                       model.coupling()->overlap().particle_id.end());
  const auto left =
      std::count_if(at_first.begin(), at_first.end(), [&](const auto id) { return !at_last.contains(id); });
  double way = 0.;
  for (const Vec3 &v : model.grains()->particles.velocity)
    way += v[0] / speed / static_cast<double>(model.grains()->particles.size());
  CAPTURE(model.coupling()->n_renewals(), left, way, largest_jump, most_elastic, end.wall_work - start.wall_work,
          end.coupling - start.coupling, end.weight_work - start.weight_work, end.balance() - start.balance());
  CHECK(model.coupling()->n_renewals() > 15);
  CHECK(left > 10); // so elements are filled only in part behind the grains
  CHECK(way > 0.8); // of the speed is left: nothing holds them back
  CHECK(largest_jump < 0.02);
  CHECK(std::abs(end.weight_work - start.weight_work) > 1e-2 * most_elastic); // else the next lines see nothing of it
  CHECK(std::abs(end.balance() - start.balance()) < 1e-4 * (end.wall_work - start.wall_work));
  CHECK(std::abs(end.balance() - start.balance()) < 1e-2 * most_elastic);
}

TEST_CASE("an overlap stays where grains and elements go together, and where grains move far from its elements")
{
  TwoScaleModel model = test::make_pressed_model(soft_and_renewed());
  model.compute_forces();
  model.kick();
  model.drift();
  model.compute_forces();
  const double diameter = model.coupling()->overlap().mean_diameter();
  dem::Particles &grains = model.grains()->particles;
  const auto shift = [&](const Vec3 &way)
  {
    for (Vec3 &x : grains.position)
      x += way;
    grains.largest_motion += way.norm();
    for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
      for (int d = 0; d < 3; ++d)
        model.body()->displacement()[3 * node + d] += way[d];
  };
  const auto renewals_of = [&](const int n_looks)
  {
    const std::int64_t before = model.coupling()->n_renewals();
    for (int look = 0; look < n_looks; ++look)
      model.overlap()->follow(0.);
    return model.coupling()->n_renewals() - before;
  };
  shift({0., 0., -0.2 * diameter}); // grains come where elements were in their reference configuration
  CHECK(renewals_of(5) == 1);       // grains outside of the overlap may have come into elements; then all is known
  CHECK(renewals_of(5) == 0);

  const std::vector<int> &nodes = model.coupling()->overlap().nodes;
  double edge = -1e300; // upper end of the elements
  for (const int node : nodes)
    edge = std::max(edge, model.body()->node_position()[node][2]);
  std::size_t far = 0;
  for (std::size_t i = 0; i < grains.size(); ++i)
    if (grains.position[i][2] > grains.position[far][2])
      far = i;
  const double distance = grains.position[far][2] - edge;
  REQUIRE(distance > 1.5 * diameter);
  grains.position[far][2] -= 0.5 * distance;
  grains.largest_motion += 0.5 * distance;
  CHECK(renewals_of(2) == 0);
  grains.position[far][2] = edge + 0.1 * diameter;
  grains.largest_motion += 0.5 * distance;
  CHECK(renewals_of(2) == 1);
}

TEST_CASE("an overlap that was made anew goes on with the same bits after a restart")
{
  const double surface_reach = GENERATE(0., 3.);
  TwoScaleModel model = make_passing_model(surface_reach);
  const dem::Box box = cube_of(model);
  test::run(model, 3000);
  REQUIRE(model.coupling()->n_renewals() > 1);
  const TemporaryFolder folder;
  {
    ArchiveWriter writer(folder / "snapshot.h5", "overlap");
    dem::write_simulation(writer, *model.grains());
    StateWriter state(writer, "coupling");
    state("overlap", std::as_const(*model.overlap()));
    writer.commit();
  }
  std::vector<std::vector<double>> of_body;
  for (const auto &[name, values] : model.body()->state())
    of_body.emplace_back(values.begin(), values.end());
  const std::vector<Vec3> reference = model.overlap()->reference_by_id();
  const auto go_on = [](TwoScaleModel &m)
  {
    const std::int64_t before = m.coupling()->n_renewals();
    test::run(m, 3000);
    CHECK(m.coupling()->n_renewals() > before);
    const auto u = std::as_const(*m.body()).external_force();
    return std::pair(dem::state_hash(*m.grains()), std::vector<double>(u.begin(), u.end()));
  };
  const auto end = go_on(model);

  ArchiveReader reader(folder / "snapshot.h5", "overlap");
  auto grains = dem::read_simulation(reader, model.grains()->parameters());
  // Grains have moved, so the edge that is made at a restart can be another one.
  coupling::CouplingParameters fewer_held = soft_and_renewed(surface_reach);
  fewer_held.edge.depth *= 0.5;
  TwoScaleModel again = test::join_below(std::move(grains), box, fewer_held, reference);
  hold_still(*again.body());
  std::size_t k = 0;
  for (const auto &[name, values] : again.body()->state())
    std::copy(of_body[k].begin(), of_body[k].end(), values.begin()), ++k;
  const std::size_t n_held = again.coupling()->edge().size();
  StateReader state(reader, "coupling");
  state("overlap", *again.overlap());
  REQUIRE(again.coupling()->edge().size() > n_held);
  CHECK(go_on(again) == end);
}
