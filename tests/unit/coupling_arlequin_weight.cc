#include "coupling/arlequin/weight.h"
#include "coupling_arlequin_block.h"

#include <catch2/catch.hpp>

using namespace bergamo::coupling;

TEST_CASE("particle weights follow a linear field and stay within their bounds")
{
  const Overlap overlap = test::block(2, 20);
  std::vector<double> node_weight;
  const Eigen::Vector3d first = overlap.node_position.front(), last = overlap.node_position.back();
  const auto field = [&](const Eigen::Vector3d &x)
  { return (x - first).dot(last - first) / (last - first).squaredNorm(); };
  for (const Eigen::Vector3d &x : overlap.node_position)
    node_weight.push_back(std::clamp(field(x), 0., 1.));

  const std::vector<double> weight = particle_weights(overlap, node_weight);
  REQUIRE(weight.size() == overlap.n_particles());
  for (std::size_t i = 0; i < weight.size(); ++i)
    CHECK(weight[i] == Approx(std::max(field(overlap.reference_position[i]), default_min_weight)).epsilon(1e-12));

  const std::vector<double> none(overlap.n_nodes(), 0.), all(overlap.n_nodes(), 1.);
  for (const double w : particle_weights(overlap, none, 0.02))
    CHECK(w == 0.02);
  for (const double w : particle_weights(overlap, all, 0.02))
  {
    CHECK(w <= 1.);
    CHECK(w == Approx(1.).epsilon(1e-14));
  }
}

TEST_CASE("bad weights are named")
{
  const Overlap overlap = test::block(1, 20);
  std::vector<double> node_weight(overlap.n_nodes(), 0.5);
  CHECK_THROWS_WITH(particle_weights(overlap, node_weight, 0.), Catch::Contains("least weight 0"));
  CHECK_THROWS_WITH(particle_weights(overlap, node_weight, std::nan("")), Catch::Contains("least weight"));
  node_weight[0] = 1.5;
  CHECK_THROWS_WITH(particle_weights(overlap, node_weight), Catch::Contains("weight 1.5") && Catch::Contains("0.3"));
  node_weight.pop_back();
  CHECK_THROWS_WITH(particle_weights(overlap, node_weight), Catch::Contains("7 weights for 8"));
}

TEST_CASE("weights grow from 0 to 1 through an overlap, smoothly without slope at its ends")
{
  for (const WeightShape shape : {WeightShape::linear, WeightShape::smooth})
  {
    CHECK(weight_at(shape, -0.5) == 0.);
    CHECK(weight_at(shape, 0.) == 0.);
    CHECK(weight_at(shape, 0.5) == 0.5);
    CHECK(weight_at(shape, 1.) == 1.);
    CHECK(weight_at(shape, 1.5) == 1.);
    // Both models have the same shape, each from its own side.
    CHECK(weight_at(shape, 0.2) + weight_at(shape, 0.8) == Approx(1.).epsilon(1e-15));
  }
  CHECK(weight_at(WeightShape::linear, 0.25) == 0.25);
  CHECK(weight_at(WeightShape::smooth, 1e-4) == Approx(3e-8).epsilon(1e-3));
}
