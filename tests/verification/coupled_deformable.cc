// Grains and bodies of elements that meet on their faces.

#include "coupling/adapter/surface_contact.h"
#include "coupling/model/model.h"
#include "dem/io/snapshot.h"
#include "fe_dealii/membrane_body.h"
#include "fe_dealii/mesh/box_mesh.h"

#include "tests/grains_on_bodies.h"
#include "tests/solid_shapes.h"
#include "tests/surfaces.h"
#include "tests/temporary_folder.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

using namespace bergamo;
using namespace bergamo::coupling;
using bergamo::fe::Shape;

namespace
{

constexpr double mm = 1e-3, density = 2650., gravity = 9.81;

dem::SimulationParameters grains_of(const double friction, const double damping, const double time_step)
{
  dem::SimulationParameters p = dem::test::soft_grains(friction, damping);
  p.gravity.setZero();
  p.time_step = time_step;
  return p;
}

const fe::Material rubber = fe::NeoHooke(fe::ElasticParameters{1e7, 0.3, 1200.}); // turns freely

struct Block
{
  Vec3 low, high;
  std::array<unsigned int, 3> n;
  Shape shape = Shape::plain;
  fe::Material material = rubber;
  double gravity = 0., damping = 0.;
};

std::unique_ptr<fe::ExplicitBody> make(const Block &block)
{
  dealii::Triangulation<3> mesh;
  fe::make_box({{block.low[0], block.low[1], block.low[2]}, {block.high[0], block.high[1], block.high[2]}, block.n},
               mesh);
  fe::ExplicitBodyParameters p;
  fe::set_shape(p, block.shape);
  p.material = block.material;
  p.gravity = {0., 0., -block.gravity};
  p.damping = block.damping;
  return std::make_unique<fe::ExplicitBody>(mesh, p);
}

/// All six faces of a box.
fe::FaceTriangles faces_of(const fe::ExplicitBody &body, const unsigned int n_squares)
{
  std::vector<fe::Surface> sides;
  for (unsigned int id = 0; id < 6; ++id)
    sides.push_back(fe::boundary_surface(body.dof_handler(), id));
  return fe::divide_faces(sides, n_squares);
}

struct GrainsAndBody
{
  Model model;
  GrainsMover *grains = nullptr;
  BodyMover *body = nullptr;
  SurfaceContact *contact = nullptr;

  GrainsAndBody(std::unique_ptr<dem::Simulation> simulation, std::unique_ptr<fe::MovingBody> moving,
                const fe::FaceTriangles &faces, const double offset = 0.)
  {
    grains = &model.add(std::make_unique<GrainsMover>(std::move(simulation)));
    body = &model.add(std::make_unique<BodyMover>(std::move(moving), "block"));
    if (grains->simulation().surfaces.empty()) // else it was stored with the grains
    {
      dem::Surface surface = surface_of(body->body(), faces);
      surface.offset = offset;
      grains->simulation().add_surface(std::move(surface));
    }
    contact = &model.add(std::make_unique<SurfaceContact>(*grains, *body, faces, 0));
  }
  GrainsAndBody(const dem::SimulationParameters &p, const dem::Particles &particles,
                std::unique_ptr<fe::MovingBody> moving, const fe::FaceTriangles &faces, const double offset = 0.)
      : GrainsAndBody(std::make_unique<dem::Simulation>(p, particles, std::vector<dem::PlaneWall>()), std::move(moving),
                      faces, offset)
  {
  }

  double time_step() const { return grains->simulation().parameters().time_step; }
  void step() { model.step(time_step()); }
  int n_touching() const { return grains->simulation().contacts.n_touching_walls(); }

  Vec3 body_momentum() const
  {
    Vec3 sum = Vec3::Zero();
    for (std::size_t dof = 0; dof < body->body().mass().size(); ++dof)
      sum[dof % 3] += body->body().mass()[dof] * body->body().velocity()[dof];
    return sum;
  }

  Vec3 momentum() const
  {
    Vec3 sum = body_momentum();
    const dem::Particles &p = grains->simulation().particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.mass[i] * p.velocity[i];
    return sum;
  }

  Vec3 place(const std::size_t node) const
  {
    const fe::MovingBody &b = body->body();
    return {b.node_position()[node][0] + b.displacement()[3 * node],
            b.node_position()[node][1] + b.displacement()[3 * node + 1],
            b.node_position()[node][2] + b.displacement()[3 * node + 2]};
  }

  /// About the origin, after a drift.
  Vec3 angular_momentum() const
  {
    Vec3 sum = Vec3::Zero();
    const fe::MovingBody &b = body->body();
    for (std::size_t node = 0; node < b.n_nodes(); ++node)
      sum += b.mass()[3 * node] * place(node).cross(Eigen::Map<const Vec3>(&b.velocity()[3 * node]));
    const dem::Particles &p = grains->simulation().particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      sum += p.mass[i] * p.position[i].cross(p.velocity[i]) + p.angular_momentum[i];
    return sum;
  }

  /// Kinetic, stored and lost less what came from outside, between kick and drift [J].
  double energy() const { return test::energy_of({grains, body}); }
};

Block target(const Shape shape)
{
  return {Vec3(-4., -3., 0.) * mm, Vec3(4., 3., 2.) * mm, {4, 3, 1}, shape};
}

struct Kind
{
  Shape shape;
  unsigned int n_squares; // of the contact's triangles along a face's side
};

const Kind kinds[] = {{Shape::plain, 1}, {Shape::bending, 2}, {Shape::quadratic, 2}, {Shape::quadratic, 4}};

GrainsAndBody impact(const Kind &kind, const double friction, const double damping, const double time_step)
{
  auto body = make(target(kind.shape));
  const fe::FaceTriangles faces = faces_of(*body, kind.n_squares);
  return {grains_of(friction, damping, time_step), test::projectiles({-1.05 * mm, 0.2 * mm, Vec3(0.05, -0.02, 0.5)}),
          std::move(body), faces};
}

} // namespace

TEST_CASE("grains and a free body of elements exchange momentum, angular momentum and energy")
{
  // Exact to rounding: momentum and angular momentum. Energy: of second order in the step, which forces that do other
  // work on the nodes than on the surface would not be, however small the step.
  const Threads one(1);
  const int k = GENERATE(0, 1, 2, 3);
  const bool is_rough = GENERATE(false, true);
  const double friction = is_rough ? 0.3 : 0., damping = is_rough ? 0.3 : 0.;
  double left[2];
  for (int n = 0; n < 2; ++n)
  {
    const double time_step = 2e-6 / (n == 0 ? 1 : 4);
    GrainsAndBody s = impact(kinds[k], friction, damping, time_step);
    const Vec3 before = s.momentum();
    s.model.compute_forces();
    s.model.kick(time_step);
    const double energy = s.energy();
    s.model.drift(time_step);
    const Vec3 angular = s.angular_momentum();
    const double kinetic = s.grains->energy().kinetic;
    double most = 0.;
    int touched = 0;
    for (int step = 1; step * time_step < 2.5e-3; ++step)
    {
      s.model.compute_forces();
      s.model.kick(time_step);
      most = std::max(most, std::abs(s.energy() - energy));
      touched = std::max(touched, s.n_touching());
      s.model.drift(time_step);
    }
    CHECK(touched > 1);
    CHECK(s.n_touching() == 0); // all have rebounded
    CHECK((s.momentum() - before).norm() < 1e-12 * before.norm());
    CHECK((s.angular_momentum() - angular).norm() < 1e-12 * before.norm() * 3. * mm);
    CHECK(s.body_momentum()[2] > 0.2 * before[2]);
    CHECK(s.body->energy().stored > 0.); // it vibrates
    left[n] = most / kinetic;
  }
  CAPTURE(k, is_rough, left[0], left[1]);
  CHECK(left[0] < 1e-5);
  CHECK(left[1] < (is_rough ? 0.3 : 0.15) * left[0]); // of second order it is 1/16; sticking ends with jumps
}

namespace
{

/// Of its overlaps with faces, from those with the planes of these [m].
double largest_miss_of_the_sphere(const dem::Simulation &grains)
{
  const std::int32_t sphere = grains.index_of(0);
  double miss = 0.;
  for (const dem::TouchingContact &contact : grains.contacts.touching_walls(grains.particles))
  {
    const dem::FeatureOfSurface f = dem::feature_of(grains.surfaces, contact.feature);
    if (contact.first != sphere || f.feature != dem::Feature::face)
      continue;
    const std::vector<Vec3> &node = grains.surfaces[0].node;
    const auto &[a, b, c] = grains.surfaces[0].topology.triangle[f.number];
    const Vec3 normal = (node[b] - node[a]).cross(node[c] - node[a]).normalized();
    const double overlap = mm - normal.dot(grains.particles.position[sphere] - node[a]);
    miss = std::max(miss, std::abs(overlap - contact.state.overlap));
  }
  return miss;
}

} // namespace

TEST_CASE("forces on the nodes of a body of elements have the sum and the moment of the contacts, which lie on it")
{
  const Threads one(1);
  for (const Kind &kind : kinds)
  {
    GrainsAndBody s = impact(kind, 0.5, 0.3, 1e-6);
    int n_compared = 0;
    double worst = 0.;
    for (int n = 0; n < 2500; ++n)
    {
      s.model.compute_forces();
      if (s.n_touching() > 0)
      {
        const dem::SurfaceLoad load = s.grains->simulation().surface_loads()[0];
        Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
        for (std::size_t node = 0; node < s.body->body().n_nodes(); ++node)
        {
          const Vec3 f = Eigen::Map<const Vec3>(&s.body->body().external_force()[3 * node]);
          force += f;
          moment += s.place(node).cross(f);
        }
        REQUIRE((force - load.force).norm() <= 1e-13 * load.force.norm());
        REQUIRE((moment - load.moment).norm() <= 1e-13 * load.force.norm() * 10. * mm);
        ++n_compared;
        worst = std::max(worst, largest_miss_of_the_sphere(s.grains->simulation()));
      }
      s.model.kick(1e-6);
      s.model.drift(1e-6);
    }
    CHECK(n_compared > 100);
    CHECK(worst < 1e-14 * mm); // rounding of places: a face that deforms is never followed by its motion alone
  }
}

TEST_CASE("a block of elements hit in its middle goes on with the velocity of two masses")
{
  // Stiff beside the grain, so little is left in vibrations: as two rigid bodies, to the share that these take.
  const Threads one(1);
  dem::Particles grains;
  grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(0., 0., -1.01) * mm, Quaternion::Identity());
  grains.velocity[0] = Vec3(0., 0., 0.02);
  auto body = make({Vec3(-1.5, -1.5, 0.) * mm,
                    Vec3(1.5, 1.5, 3.) * mm,
                    {2, 2, 2},
                    Shape::bending,
                    fe::NeoHooke(fe::ElasticParameters{1e10, 0.3, density})});
  const fe::FaceTriangles faces = faces_of(*body, 1);
  GrainsAndBody s(grains_of(0., 0., 2e-7), grains, std::move(body), faces);
  const double m1 = s.grains->simulation().particles.mass[0], m2 = density * 27. * std::pow(mm, 3);
  while (s.n_touching() == 0)
    s.step();
  while (s.n_touching() > 0)
    s.step();
  const double expected = 0.02 * 2. * m1 / (m1 + m2);
  CHECK(s.body_momentum()[2] / m2 == Approx(expected).epsilon(2e-3));
  CHECK(s.grains->simulation().particles.velocity[0][2] == Approx(0.02 - expected * m2 / m1).margin(2e-3 * 0.02));
}

TEST_CASE("grains on a block, and a block on grains, weigh what they weigh")
{
  // Smooth: what rolls on springs of friction would go on for long.
  const Threads one(1);
  constexpr double time_step = 2e-6, alpha = 400.;
  SECTION("grains on a block")
  {
    Block block = target(GENERATE(Shape::plain, Shape::quadratic));
    block.gravity = gravity;
    block.damping = alpha;
    dem::Particles grains;
    for (int k = 0; k < 3; ++k)
      grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(2.4 * (k - 1), 0.3 * k, 3.) * mm, Quaternion::Identity());
    auto body = make(block);
    const auto foot = body->prescribe_velocity(4u, 2);
    const fe::FaceTriangles faces = faces_of(*body, 2);
    dem::SimulationParameters p = grains_of(0., 0.5, time_step);
    p.gravity[2] = -gravity;
    GrainsAndBody s(p, grains, std::move(body), faces);
    for (int n = 0; n < 40000; ++n)
      s.step();
    double weight = 0.;
    for (std::size_t i = 0; i < 3; ++i)
      weight += s.grains->simulation().particles.mass[i] * gravity;
    s.model.compute_forces();
    s.model.kick(time_step);
    const double of_block = 1200. * 8. * 6. * 2. * std::pow(mm, 3) * gravity;
    CHECK(s.grains->simulation().surface_loads()[0].force[2] == Approx(-weight).epsilon(1e-6));
    CHECK(s.body->body().reaction(foot) - of_block == Approx(weight).epsilon(1e-6));
  }
  SECTION("a block on grains")
  {
    Block block = target(GENERATE(Shape::bending, Shape::quadratic));
    block.gravity = gravity;
    block.damping = alpha;
    dem::Particles grains;
    for (int k = 0; k < 4; ++k)
      grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(k & 1 ? 2.7 : -2.6, k & 2 ? 1.9 : -2.1, -1.) * mm,
                 Quaternion::Identity());
    dem::PlaneWall floor;
    floor.normal = Vec3::UnitZ();
    floor.point = Vec3(0., 0., -2. * mm);
    auto body = make(block);
    const fe::FaceTriangles faces = faces_of(*body, 2);
    GrainsAndBody s(std::make_unique<dem::Simulation>(grains_of(0., 0.5, time_step), grains, std::vector{floor}),
                    std::move(body), faces);
    for (int n = 0; n < 40000; ++n)
      s.step();
    s.model.compute_forces();
    const double of_block = 1200. * 8. * 6. * 2. * std::pow(mm, 3) * gravity;
    CHECK(s.grains->simulation().surface_loads()[0].force[2] == Approx(of_block).epsilon(1e-6));
    CHECK(s.grains->simulation().walls[0].force[2] == Approx(-of_block).epsilon(1e-6)); // the grains have no weight
  }
}

TEST_CASE("contacts with a body of elements give the same bits on any number of threads and after a restart")
{
  constexpr double time_step = 1e-6;
  const auto start = [] { return impact(kinds[2], 0.3, 0.1, time_step); };
  const auto state_of = [](const GrainsAndBody &s)
  {
    std::vector<double> state;
    for (const auto &[name, values] : s.body->body().state())
      state.insert(state.end(), values.begin(), values.end());
    return std::pair(dem::state_hash(s.grains->simulation()), state);
  };
  using State = decltype(state_of(start()));
  std::vector<State> ends;
  const TemporaryFolder folder;
  for (const int n_threads : {1, 2, 3})
  {
    const Threads threads(n_threads);
    GrainsAndBody s = start();
    for (int n = 0; n < 800; ++n)
    {
      if (n == 300 && n_threads == 1) // while they touch
      {
        REQUIRE(s.n_touching() > 0);
        ArchiveWriter writer(folder / "snapshot.h5", "deformable");
        dem::write_simulation(writer, s.grains->simulation());
        writer.commit();
        ends.push_back(state_of(s));
      }
      s.step();
    }
    ends.push_back(state_of(s));
  }
  CHECK(ends[1] == ends[2]);
  CHECK(ends[1] == ends[3]);

  const Threads one(1);
  auto body = make(target(kinds[2].shape));
  const fe::FaceTriangles faces = faces_of(*body, kinds[2].n_squares);
  GrainsAndBody again(
      dem::read_simulation(ArchiveReader(folder / "snapshot.h5", "deformable"), grains_of(0.3, 0.1, time_step)),
      std::move(body), faces);
  auto stored = ends[0].second.begin();
  for (const auto &[name, values] : again.body->body().state())
  {
    std::copy_n(stored, values.size(), values.begin());
    stored += static_cast<std::ptrdiff_t>(values.size());
  }
  for (int n = 300; n < 800; ++n)
    again.step();
  CHECK(state_of(again) == ends[1]);
}

TEST_CASE("what a grain gets from a beam of elements converges with their number")
{
  // Held at its ends, hit in the middle by a sphere of a fifth of its mass.
  const Threads one(1);
  const auto rebound = [](const Shape shape, const unsigned int n)
  {
    auto body = make({Vec3(-10., -1., 0.) * mm,
                      Vec3(10., 1., 2.) * mm,
                      {n, 1, 1},
                      shape,
                      fe::LinearElastic(fe::ElasticParameters{1e8, 0.3, density})});
    for (const unsigned int end : {0u, 1u})
      body->prescribe_velocity(end, 2);
    body->prescribe_velocity(0u, 0);
    body->prescribe_velocity(2u, 1);
    dem::Particles grains;
    grains.add({Vec3::Constant(1.5 * mm), 1., 1.}, density, Vec3(0., 0., 3.51) * mm, Quaternion::Identity());
    grains.velocity[0] = Vec3(0., 0., -0.05);
    const fe::Surface top = fe::boundary_surface(body->dof_handler(), 5);
    const fe::FaceTriangles faces = fe::divide_faces({&top, 1}, 2);
    GrainsAndBody s(grains_of(0., 0., 1e-6), grains, std::move(body), faces);
    for (int k = 0; k < 4000; ++k)
      s.step();
    return s.grains->simulation().particles.velocity[0][2];
  };
  for (const Shape shape : {Shape::bending, Shape::quadratic})
  {
    const unsigned int n = shape == Shape::bending ? 4 : 2;
    const double coarse = rebound(shape, n), middle = rebound(shape, 2 * n), fine = rebound(shape, 4 * n);
    CAPTURE(coarse, middle, fine);
    CHECK(fine > -0.04); // was turned back, at least in part
    CHECK(std::abs(fine - middle) < 0.5 * std::abs(middle - coarse));
    CHECK(std::abs(fine - middle) < 0.02 * 0.05);
  }
}

namespace
{

/// A square of rubber about the origin at z = 0, held at its rim or not, with both of its sides to touch.
std::unique_ptr<fe::MembraneBody> sheet(const bool is_held)
{
  dealii::Triangulation<2> flat;
  dealii::GridGenerator::subdivided_hyper_rectangle(flat, {6, 6}, dealii::Point<2>(-6. * mm, -6. * mm),
                                                    dealii::Point<2>(6. * mm, 6. * mm));
  dealii::Triangulation<2, 3> mesh;
  dealii::GridGenerator::flatten_triangulation(flat, mesh);
  fe::MembraneBodyParameters p;
  p.thickness = 0.3 * mm;
  auto body = std::make_unique<fe::MembraneBody>(mesh, p);
  std::vector<unsigned int> rim;
  for (unsigned int node = 0; node < body->n_nodes(); ++node)
    if (const auto &x = body->node_position()[node]; std::max(std::abs(x[0]), std::abs(x[1])) > 5.9 * mm)
      rim.push_back(node);
  if (is_held)
    for (unsigned int component = 0; component < 3; ++component)
      body->prescribe_velocity(rim, component);
  return body;
}

fe::FaceTriangles both_sides_of(const fe::MembraneBody &body)
{
  const fe::Surface surface = fe::membrane_surface(body.dof_handler());
  return fe::both_sides(fe::divide_faces({&surface, 1}, 1));
}

} // namespace

TEST_CASE("a membrane turns a grain back on either side alike, and keeps the balances")
{
  const Threads one(1);
  const double offset = GENERATE(0., 0.15) * mm;
  std::vector<Vec3> ways[2];
  for (const int side : {0, 1})
  {
    const double up = side == 0 ? 1. : -1.;
    auto body = sheet(true);
    const fe::FaceTriangles faces = both_sides_of(*body);
    dem::Particles grains;
    grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(0.3 * mm, 0.8 * mm, (1.01 * mm + offset) * up),
               Quaternion::Identity());
    grains.velocity[0] = Vec3(0.02, 0., -0.3 * up);
    GrainsAndBody s(grains_of(0.3, 0., 1e-6), grains, std::move(body), faces, offset);
    s.model.compute_forces();
    s.model.kick(1e-6);
    const double energy = s.energy(), kinetic = s.grains->energy().kinetic;
    s.model.drift(1e-6);
    double most = 0., deepest = 1.;
    for (int n = 0; n < 20000; ++n)
    {
      s.model.compute_forces();
      s.model.kick(1e-6);
      most = std::max(most, std::abs(s.energy() - energy));
      s.model.drift(1e-6);
      Vec3 place = s.grains->simulation().particles.position[0];
      place[2] *= up;
      deepest = std::min(deepest, place[2]);
      ways[side].push_back(place);
    }
    CAPTURE(offset, side, deepest, most / kinetic);
    CHECK(deepest < 0.8 * mm + offset); // the sheet gives way
    CHECK(ways[side].back()[2] > 1.5 * mm);
    CHECK(most < 1e-3 * kinetic);
  }
  double farthest = 0.;
  for (std::size_t k = 0; k < ways[0].size(); ++k)
    farthest = std::max(farthest, (ways[0][k] - ways[1][k]).norm());
  CHECK(farthest < 1e-9 * mm); // rounding, which the contact magnifies
}

TEST_CASE("a grain at a membrane's rim meets one rim, not one of either side")
{
  // The force is that of one edge, whichever rim it is and however the sheet lies: the normals of its two sides are
  // opposite but for rounding, which must not decide which way round the rim goes.
  const Threads one(1);
  const double overlap = 1e-3 * mm, offset = GENERATE(0., 0.15) * mm;
  double force = 0.;
  for (const double angle : {0., 0.3, 1.1, 2.5})
    for (int rim = 0; rim < 4; ++rim)
    {
      auto body = sheet(false);
      const Mat3 turned = Eigen::AngleAxisd(angle, Vec3(1., 2., -0.5).normalized()).toRotationMatrix();
      for (std::size_t node = 0; node < body->n_nodes(); ++node)
      {
        const Vec3 x = Eigen::Map<const Vec3>(body->node_position()[node].data());
        Eigen::Map<Vec3>(&body->displacement()[3 * node]) = turned * x - x;
      }
      const Vec3 outward =
          turned * Eigen::AngleAxisd(0.5 * rim * std::numbers::pi, Vec3::UnitZ()).toRotationMatrix() * Vec3::UnitX();
      const fe::FaceTriangles faces = both_sides_of(*body);
      dem::Particles grains;
      grains.add({Vec3::Constant(mm), 1., 1.}, density,
                 (7. * mm + offset - overlap) * outward + 0.8 * mm * turned.col(2).cross(outward),
                 Quaternion::Identity());
      GrainsAndBody s(grains_of(0., 0., 1e-6), grains, std::move(body), faces, offset);
      s.model.compute_forces();
      const auto contacts = s.grains->simulation().contacts.touching_walls(s.grains->simulation().particles);
      REQUIRE(contacts.size() == 1);
      CHECK(contacts[0].state.weight == 1.);
      CHECK(contacts[0].state.overlap == Approx(overlap).epsilon(1e-9));
      const Vec3 found = s.grains->simulation().particles.force[0];
      if (force == 0.)
        force = found.norm();
      CHECK((found - force * outward).norm() < 1e-9 * force);
      dem::Surface other = s.grains->simulation().surfaces[0];
      other.offset = -offset - 1e-9;
      CHECK_THROWS_WITH(s.grains->simulation().add_surface(other), Catch::Contains("offset of a surface"));
    }
}

TEST_CASE("the stable step of a contact with a body of elements is that of its nodes")
{
  // A sphere above a node: twice the contact's stiffness against the node's mass, as bound.
  const Threads one(1);
  auto body = make(target(Shape::plain));
  const fe::FaceTriangles faces = faces_of(*body, 1);
  dem::Particles grains;
  const double overlap = 1e-3 * mm;
  grains.add({Vec3::Constant(mm), 1., 1.}, density, Vec3(0., 1., 3.) * mm - Vec3(0., 0., overlap),
             Quaternion::Identity());
  const unsigned int node = [&]
  {
    for (unsigned int k = 0; k < body->n_nodes(); ++k)
      if (const auto &x = body->node_position()[k]; std::hypot(x[0], x[1] - mm, x[2] - 2. * mm) < 1e-9)
        return k;
    return 0u;
  }();
  const double mass = body->mass()[3 * node];
  CHECK(mass == Approx(1200. * 8. / 2. * std::pow(mm, 3)));
  GrainsAndBody s(grains_of(0., 0., 1e-6), grains, std::move(body), faces);
  CHECK(s.contact->stable_step() == std::numeric_limits<double>::infinity()); // no contact is known yet
  s.model.compute_forces();
  REQUIRE(s.n_touching() > 0);
  const auto contacts = s.grains->simulation().contacts.touching_walls(s.grains->simulation().particles);
  double stiffness = 0.;
  for (const dem::TouchingContact &c : contacts)
    stiffness += std::abs(c.state.weight) * std::sqrt(c.state.overlap) *
                 std::max(1.5 * c.state.stiffness.normal, c.state.stiffness.tangential_major);
  CHECK(s.contact->stable_step() == Approx(2. / std::sqrt(2. * stiffness / mass)));
  CHECK(s.model.stable_steps().combined() < s.body->stable_step());
}

TEST_CASE("a light body between grains is stable at the step that the model names, and not far above it")
{
  const Threads one(1);
  const auto pinched = [](const double time_step)
  {
    auto body = make({Vec3(-1., -1., 0.) * mm,
                      Vec3(1., 1., 0.5) * mm,
                      {1, 1, 1},
                      Shape::plain,
                      fe::NeoHooke(fe::ElasticParameters{1e4, 0.3, 100.})});
    dem::Particles grains; // so heavy that they rest
    for (const double side : {-1., 1.})
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
          grains.add({Vec3::Constant(0.4 * mm), 1., 1.}, 1e12, Vec3(x, y, 0.25 + side * 0.648) * mm,
                     Quaternion::Identity());
    const fe::FaceTriangles faces = faces_of(*body, 2);
    GrainsAndBody s(grains_of(0., 0., time_step), grains, std::move(body), faces);
    s.model.compute_forces();
    return s;
  };
  // All of the energy is in the contacts at the start.
  const auto growth = [&](const double time_step)
  {
    GrainsAndBody s = pinched(time_step);
    s.model.kick(time_step);
    const double energy = s.energy(), stored = s.grains->energy().stored;
    double most = 0.;
    for (int n = 0; n < 2000 && most < 10. * stored; ++n)
    {
      s.model.drift(time_step);
      s.model.compute_forces();
      s.model.kick(time_step);
      most = std::max(most, std::abs(s.energy() - energy));
    }
    return most / stored;
  };
  GrainsAndBody s = pinched(1e-9);
  const double step = s.model.stable_steps().combined();
  CHECK(s.body->stable_step() > 2. * step); // the contacts set it
  CHECK(growth(0.9 * step) < 0.01);
  CHECK(growth(2. * step) > 1.);
}
