#include "coupling/arlequin/projection.h"
#include "coupling_arlequin_block.h"
#include "dem/core/error.h"

#include <catch2/catch.hpp>
#include <functional>
#include <sstream>

using namespace bergamo::coupling;
using Vectors = std::vector<Eigen::Vector3d>;

namespace
{

Vectors random_vectors(const std::size_t n, const unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vectors vectors(n);
  for (Eigen::Vector3d &vector : vectors)
    vector = Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  return vectors;
}

double dot(const Vectors &a, const Vectors &b)
{
  double sum = 0.;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += a[i].dot(b[i]);
  return sum;
}

double largest(const Vectors &vectors)
{
  double norm = 0.;
  for (const Eigen::Vector3d &vector : vectors)
    norm = std::max(norm, vector.norm());
  return norm;
}

Vectors at(const Vectors &places, const std::function<Eigen::Vector3d(const Eigen::Vector3d &)> &field)
{
  Vectors values;
  for (const Eigen::Vector3d &place : places)
    values.push_back(field(place));
  return values;
}

const auto homogeneous = [](const Eigen::Vector3d &x) -> Eigen::Vector3d
{
  Eigen::Matrix3d gradient;
  gradient << 0.01, -0.03, 0.002, 0.04, -0.02, 0.007, -0.005, 0.01, 0.03;
  return Eigen::Vector3d(1e-3, -2e-3, 5e-4) + gradient * x;
};

std::string message_of(const std::function<void()> &action)
{
  try
  {
    action();
  }
  catch (const bergamo::ConfigError &error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("a common homogeneous deformation leaves no difference")
{
  const Overlap overlap = test::block(3, 12);
  const Vectors particles = at(overlap.reference_position, homogeneous), nodes = at(overlap.node_position, homogeneous);
  for (const Projection kind : {Projection::lumped, Projection::consistent})
  {
    const CoarseProjection projection(overlap, kind);
    Vectors difference(overlap.n_particles()), r(overlap.n_nodes());
    projection.blocks()->interpolate(nodes, difference);
    for (std::size_t i = 0; i < difference.size(); ++i)
      difference[i] = particles[i] - difference[i];
    projection.project(difference, r);
    CHECK(largest(r) < 1e-13 * largest(nodes));

    // The dissertation's form: project first, subtract at the nodes.
    projection.project(particles, r);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] -= nodes[i];
    if (kind == Projection::consistent)
      CHECK(largest(r) < 1e-12 * largest(nodes));
    else
      CHECK(largest(r) > 1e-2 * largest(nodes));
  }
}

TEST_CASE("both forms of the consistent difference are the same")
{
  const Overlap overlap = test::block(2, 15);
  const CoarseProjection projection(overlap, Projection::consistent);
  const Vectors particles = random_vectors(overlap.n_particles(), 3), nodes = random_vectors(overlap.n_nodes(), 4);
  Vectors difference(overlap.n_particles()), ours(overlap.n_nodes()), theirs(overlap.n_nodes());
  projection.blocks()->interpolate(nodes, difference);
  for (std::size_t i = 0; i < difference.size(); ++i)
    difference[i] = particles[i] - difference[i];
  projection.project(difference, ours);
  projection.project(particles, theirs);
  for (std::size_t i = 0; i < ours.size(); ++i)
    CHECK((ours[i] - (theirs[i] - nodes[i])).norm() < 1e-12 * largest(theirs));
}

TEST_CASE("the lumped value of a node is the mean weighted by volume and shape function")
{
  // Two particles in one element.
  Overlap overlap = test::block(1, 2);
  const CoarseProjection projection(overlap, Projection::lumped);
  const Vectors values{Eigen::Vector3d(1., 2., 3.), Eigen::Vector3d(-5., 0., 1.)};
  Vectors nodes(8);
  projection.project(values, nodes);
  for (int node = 0; node < 8; ++node)
  {
    const double a = overlap.shape_value[node] * overlap.particle_volume[0];
    const double b = overlap.shape_value[8 + node] * overlap.particle_volume[1];
    CHECK((nodes[overlap.shape_node[node]] - (a * values[0] + b * values[1]) / (a + b)).norm() < 1e-14);
  }
}

TEST_CASE("the consistent projection is the least squares fit")
{
  const Overlap overlap = test::block(2, 14);
  const CoarseProjection projection(overlap, Projection::consistent);

  // Exact where the particles move by the ansatz, linear fields among them.
  const Vectors ansatz = random_vectors(overlap.n_nodes(), 7);
  Vectors particles(overlap.n_particles()), fit(overlap.n_nodes());
  projection.blocks()->interpolate(ansatz, particles);
  projection.project(particles, fit);
  for (std::size_t i = 0; i < fit.size(); ++i)
    CHECK((fit[i] - ansatz[i]).norm() < 1e-11);
  projection.project(at(overlap.reference_position, homogeneous), fit);
  for (std::size_t i = 0; i < fit.size(); ++i)
    CHECK((fit[i] - homogeneous(overlap.node_position[i])).norm() < 1e-13);

  // Elsewhere the weighted error is orthogonal to the ansatz.
  particles = random_vectors(overlap.n_particles(), 8);
  projection.project(particles, fit);
  Vectors error(overlap.n_particles()), normal(overlap.n_nodes());
  projection.blocks()->interpolate(fit, error);
  for (std::size_t i = 0; i < error.size(); ++i)
    error[i] = overlap.particle_volume[i] * (particles[i] - error[i]);
  projection.blocks()->collect(error, normal);
  CHECK(largest(normal) < 1e-12 * largest(error));
}

TEST_CASE("the sums of particle forces at the nodes are the transpose of the interpolation")
{
  const Overlap overlap = test::block(2, 14);
  const Vectors x = random_vectors(overlap.n_particles(), 5), f = random_vectors(overlap.n_nodes(), 6);
  Vectors on_nodes(overlap.n_nodes()), on_particles(overlap.n_particles());
  const CoarseProjection projection(overlap, Projection::lumped);
  projection.blocks()->collect(x, on_nodes);
  projection.blocks()->interpolate(f, on_particles);
  CHECK(dot(on_nodes, f) == Approx(dot(x, on_particles)).epsilon(1e-11));
}

TEST_CASE("too few particles for a consistent projection are an error that names the place")
{
  CHECK_NOTHROW(CoarseProjection(test::block(1, 5), Projection::lumped));
  CHECK_THROWS_WITH(CoarseProjection(test::block(1, 5), Projection::consistent),
                    Catch::Contains("too few particles") && Catch::Contains("lumped"));

  // The two last nodes of an edge of the block are reached from the mid-plane of one element alone: nothing tells their
  // motion apart. The other nodes have plenty of particles.
  Overlap overlap = test::block(2, 30);
  const auto flatten = [&](const int first_node, const double height)
  {
    for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
    {
      const std::size_t first = overlap.shape_offset[particle];
      if (overlap.shape_node[first] != first_node)
        continue;
      overlap.reference_position[particle].setZero();
      for (std::size_t c = first; c < first + 4; ++c)
      {
        const double both = overlap.shape_value[c] + overlap.shape_value[c + 4];
        overlap.shape_value[c] = both * (1. - height);
        overlap.shape_value[c + 4] = both * height;
        for (const std::size_t k : {c, c + 4})
          overlap.reference_position[particle] += overlap.shape_value[k] * overlap.node_position[overlap.shape_node[k]];
      }
    }
  };
  flatten(13, 0.5);
  flatten(12, 0.);
  std::string message;
  CHECK_NOTHROW(CoarseProjection(overlap, Projection::lumped));
  message = message_of([&] { CoarseProjection(overlap, Projection::consistent); });
  CHECK_THAT(message, Catch::Contains("larger elements"));
  const auto named = [&](const std::size_t node)
  {
    std::ostringstream place;
    place << "around the node at (" << overlap.node_position[node].transpose() << ") m";
    return message.find(place.str()) != std::string::npos;
  };
  INFO(message);
  CHECK((named(25) || named(26)));
}

TEST_CASE("a bad overlap is named with the place and the remedy")
{
  const Overlap good = test::block(1, 12);
  CHECK_NOTHROW(good.validate());
  const auto message = [](const Overlap &overlap) { return message_of([&] { overlap.validate(); }); };

  Overlap bad = good;
  bad.shape_value[9] += 1e-3;
  CHECK_THAT(message(bad), Catch::Contains("particle 1007") && Catch::Contains("instead of 1"));
  bad = good;
  bad.shape_value[9] = std::nan("");
  CHECK_THAT(message(bad), Catch::Contains("particle 1007"));
  bad = good;
  bad.reference_position[2].x() += 1e-3;
  CHECK_THAT(message(bad), Catch::Contains("particle 1014") && Catch::Contains("belong to the place"));
  bad = good;
  bad.shape_gradient[17] *= 1.1;
  CHECK_THAT(message(bad), Catch::Contains("particle 1014") && Catch::Contains("gradients"));
  bad = good;
  bad.particle_volume[0] = 0.;
  CHECK_THAT(message(bad), Catch::Contains("particle 1000") && Catch::Contains("volume"));
  bad = good;
  bad.nodes[3] = bad.nodes[2];
  CHECK_THAT(message(bad), Catch::Contains("each once"));
  bad = good;
  bad.shape_node[5] = 8;
  CHECK_THAT(message(bad), Catch::Contains("outside the 8 coupling nodes"));
  bad = good;
  bad.shape_offset.pop_back();
  CHECK_THAT(message(bad), Catch::Contains("rows of particles"));
  CHECK_THAT(message(Overlap()), Catch::Contains("0 nodes and 0 particles"));
}

TEST_CASE("a node that no particle reaches has no difference and no load")
{
  // A second element beside a filled one, of which no grain has come into the far half: its far nodes are reached by
  // none.
  Overlap overlap = test::block(1, 12);
  overlap.nodes.push_back(99);
  overlap.node_position.push_back(Eigen::Vector3d(0.125, 0.25, 0.5));
  CHECK_NOTHROW(overlap.validate());
  const CoarseProjection projection(overlap, Projection::lumped);
  Vectors difference(9);
  projection.project(random_vectors(overlap.n_particles(), 3), difference);
  CHECK(difference[8] == Eigen::Vector3d::Zero());
  CHECK(largest(difference) > 0.1);
  CHECK_THROWS_WITH(CoarseProjection(overlap, Projection::consistent), Catch::Contains("too few particles"));
}
