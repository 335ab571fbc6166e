// An overlap that goes elsewhere on its mesh: elements behind it are absent, grains come ahead of it, and nothing that
// is at rest notices.

#include "coupling/adapter/model_energy.h"
#include "dem/loading/compression.h"
#include "dem/state/positions_by_id.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/verification/pressed_model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <memory>

using namespace bergamo;
using coupling::TwoScaleModel;

namespace
{

/// The pressed cube, grains above and elements below, and the grains whose place the elements have taken.
struct Cube
{
  dem::Box box;
  dem::Particles below;
  TwoScaleModel model;

  static Cube make()
  {
    auto grains = test::make_pressed_packing();
    const dem::Box box = dem::box_between(grains->walls);
    const std::vector<Vec3> reference = dem::positions_by_id(grains->particles);
    dem::Particles below = test::cut_below(*grains, box);
    coupling::CouplingParameters join;
    join.transfer_time = 2e-5;
    return {box, std::move(below), test::join_below(std::move(grains), box, join, reference)};
  }

  double third() const { return box.edges()[2] / 3.; }

  /// One where grains alone count, zero at the bottom of a third of the cube, which the overlap fills then.
  std::vector<double> weight_above(const double bottom) const
  {
    std::vector<double> weight;
    for (const auto &x : model.body()->node_position())
      weight.push_back(std::clamp((x[2] - bottom) / third(), 0., 1.));
    return weight;
  }

  /// The overlap goes from the middle third to the lower one.
  void move_down()
  {
    std::vector<Vec3> reference = model.overlap()->reference_by_id();
    model.grains()->add(below);
    reference.insert(reference.end(), below.position.begin(), below.position.end());
    std::vector<double> weight = weight_above(box.low[2]);
    const double middle = box.low[2] + third();
    for (std::size_t node = 0; node < weight.size(); ++node) // exactly
      if (model.body()->node_position()[node][2] > middle - 1e-9)
        weight[node] = 1.;
    model.overlap()->move_to({weight, reference});
  }

  std::map<std::int64_t, Vec3> places() const
  {
    std::map<std::int64_t, Vec3> places;
    const dem::Particles &p = model.grains()->particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      places.emplace(p.id[i], p.position[i]);
    return places;
  }

  double pressure_on_top() const { return model.grains()->walls[4].force[2] / (box.edges()[0] * box.edges()[1]); }
};

/// Balance of the energies at this step, and the scale of it [J].
struct Account
{
  double balance, elastic;

  explicit Account(TwoScaleModel &model)
  {
    model.compute_forces();
    model.kick();
    const coupling::ModelEnergy energy = coupling::energy_of(model);
    balance = energy.balance();
    elastic = energy.grains_elastic + energy.continuum_elastic;
    model.drift();
  }
};

} // namespace

TEST_CASE("an overlap goes down under pressure: elements behind it are absent, and neither grains nor nodes are moved")
{
  Cube cube = Cube::make();
  TwoScaleModel &model = cube.model;
  test::run(model, 200);
  const Account before(model);
  const double pressure = cube.pressure_on_top();
  const std::int64_t n_grains = static_cast<std::int64_t>(model.grains()->particles.size());
  cube.move_down();
  CHECK(model.grains()->particles.size() == n_grains + cube.below.size());

  const double middle = cube.box.low[2] + cube.third();
  for (std::size_t e = 0; e < model.body()->n_elements(); ++e)
    CHECK(model.body()->is_absent(e) == (model.body()->reference_centre(e)[2] > middle));
  for (const std::int64_t id : model.coupling()->overlap().particle_id)
    CHECK(model.grains()->particles.position[model.grains()->index_of(id)][2] < middle);
  for (std::size_t i = 0; i < model.grains()->particles.size(); ++i)
    if (model.grains()->particles.position[i][2] > middle + 1e-5)
      CHECK(model.grains()->particles.weight[i] == 1.);

  // The springs of the contacts that came, and what elements took away, are booked, to the half step of works around.
  const Account after(model);
  CHECK(std::abs(after.balance - before.balance) < 1e-3 * before.elastic);
  CHECK(std::abs(after.elastic - before.elastic) > 1e-2 * before.elastic); // else that would say nothing

  const std::map<std::int64_t, Vec3> start = cube.places();
  std::vector<double> of_absent;
  const auto displacement_of_top = [&]
  {
    std::vector<double> values;
    for (std::size_t node = 0; node < model.body()->n_nodes(); ++node)
      if (model.body()->node_position()[node][2] > middle + 1e-5)
        for (int d = 0; d < 3; ++d)
          values.push_back(std::as_const(*model.body()).displacement()[3 * node + d]);
    return values;
  };
  of_absent = displacement_of_top();
  test::run(model, 3000);
  const Account later(model);
  CHECK(displacement_of_top() == of_absent);
  const double diameter = model.coupling()->overlap().mean_diameter();
  double farthest = 0., mean = 0.;
  for (const auto &[id, place] : cube.places())
  {
    const double motion = (place - start.at(id)).norm() / diameter;
    farthest = std::max(farthest, motion);
    mean += motion / static_cast<double>(start.size());
  }
  CAPTURE(farthest, mean, pressure, cube.pressure_on_top(), before.elastic, before.balance, after.balance,
          later.balance);
  CHECK(farthest < 0.05); // friction's springs have come to rest anew
  CHECK(mean < 5e-3);
  CHECK(cube.pressure_on_top() == Approx(pressure).epsilon(0.05));
  CHECK(std::abs(later.balance - after.balance) < 1e-4 * before.elastic);
}

TEST_CASE("an overlap does not go where its elements are absent, nor with weights of another mesh")
{
  Cube cube = Cube::make();
  test::run(cube.model, 5);
  const std::vector<Vec3> reference = cube.model.overlap()->reference_by_id();
  CHECK_THROWS_WITH(cube.model.overlap()->move_to({std::vector<double>(3, 0.5), reference}),
                    Catch::Matchers::Contains("give one per node"));
  cube.move_down();
  test::run(cube.model, 1);
  CHECK_THROWS_WITH(cube.model.overlap()->move_to(
                        {cube.weight_above(cube.box.low[2] + cube.third()), cube.model.overlap()->reference_by_id()}),
                    Catch::Matchers::Contains("bring back element"));
}

TEST_CASE("weights of one overlap change beside those of another")
{
  coupling::SolidMover mover(std::make_unique<fe::ExplicitBody>(
      fe::make_box_body({{0, 0, 0}, {1, 1, 2}, {1, 1, 2}}, fe::ExplicitBodyParameters())));
  const std::size_t n = mover.solid().n_nodes();
  const double whole = mover.solid().mass()[0];
  const std::vector<double> first(n, 0.2), second(n, 0.3), other(n, 0.4);
  mover.add_weights(first);
  mover.add_weights(second);
  mover.change_weights(first, other);
  for (const double weight : mover.weights())
    CHECK(weight == Approx(0.7));
  CHECK(mover.solid().mass()[0] == Approx(0.3 * whole));
}
