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
  CHECK(continuum_weight(0.25) == 0.75);
  CHECK(continuum_weight(1.) == default_min_weight);
  CHECK(continuum_weight(0.) == 1.);
}

TEST_CASE("a contact's weight lies between those of its particles")
{
  CHECK(contact_weight(0.2, 0.8, 0.) == 0.2);
  CHECK(contact_weight(0.2, 0.8, 1.) == 0.8);
  CHECK(contact_weight(0.2, 0.8, 0.25) == Approx(0.35));
  CHECK(contact_weight(0.2, 0.8, -3.) == 0.2);
  CHECK(contact_weight(0.2, 0.8, 7.) == 0.8);

  using Pack = Eigen::Array<double, 8, 1>;
  const Pack w_a = Pack::Constant(0.2), w_b = Pack::LinSpaced(0.1, 1.), fraction = Pack::LinSpaced(-0.5, 1.5);
  const Pack weight = contact_weight(w_a, w_b, fraction);
  for (int i = 0; i < 8; ++i)
    CHECK(weight[i] == Approx(contact_weight(w_a[i], w_b[i], fraction[i])));

  const Eigen::Vector3d a(1., 2., 3.), b(2., 4., 3.), aside(2., -1., 5.);
  CHECK(centre_line_fraction(a, b, Eigen::Vector3d(a + 0.3 * (b - a) + aside)) == Approx(0.3));
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
