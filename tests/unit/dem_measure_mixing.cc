#include "dem/core/error.h"
#include "dem/measure/mixing.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Grains in cells of edge 1, as many in each as a list says, on both sides of the origin.
std::vector<Vec3> in_cells(const std::vector<int> &n_grains)
{
  std::vector<Vec3> places;
  for (std::size_t cell = 0; cell < n_grains.size(); ++cell)
    for (int k = 0; k < n_grains[cell]; ++k)
      places.emplace_back(cell - 2. + (k + 0.5) / n_grains[cell], -0.3, 0.2);
  return places;
}

} // namespace

TEST_CASE("Lacey's index of kinds apart is 0, that of a chequered bed above 1")
{
  const std::vector<Vec3> places = in_cells({4, 4, 4, 4});
  std::vector<std::uint8_t> is_first(16, 0);
  std::fill_n(is_first.begin(), 8, 1);
  CHECK(lacey_index(places, is_first, 1.) == Approx(0.).margin(1e-14));
  for (std::size_t i = 0; i < 16; ++i)
    is_first[i] = i % 2;
  // Without any variance: s0^2 / (s0^2 - sr^2), with 3/15 for sr^2 / s0^2.
  CHECK(lacey_index(places, is_first, 1.) == Approx(1. / (1. - 3. / 15.)));
}

TEST_CASE("Lacey's index of a random mixture is 1 on average, whatever the numbers in the cells")
{
  const std::vector<Vec3> places = in_cells({1, 7, 2, 30, 5, 1, 4});
  std::vector<std::uint8_t> is_first(places.size(), 0);
  std::fill_n(is_first.begin(), 13, 1);
  std::mt19937_64 generator(3);
  constexpr int n = 4000;
  double sum = 0., squares = 0.;
  for (int k = 0; k < n; ++k)
  {
    std::shuffle(is_first.begin(), is_first.end(), generator);
    const double index = lacey_index(places, is_first, 1.);
    sum += index;
    squares += index * index;
  }
  const double mean = sum / n, deviation_of_mean = std::sqrt((squares / n - mean * mean) / n);
  CHECK(std::abs(mean - 1.) < 4. * deviation_of_mean);
  CHECK(deviation_of_mean < 0.01);
}

TEST_CASE("Lacey's index hangs neither on the order of the grains nor on which kind is called first")
{
  std::vector<Vec3> places = in_cells({3, 5, 2, 6});
  std::vector<std::uint8_t> is_first(places.size());
  std::mt19937_64 generator(5);
  for (std::uint8_t &first : is_first)
    first = generator() % 2;
  const double index = lacey_index(places, is_first, 1.);
  std::reverse(places.begin(), places.end());
  std::reverse(is_first.begin(), is_first.end());
  CHECK(lacey_index(places, is_first, 1.) == index);
  for (std::uint8_t &first : is_first)
    first = !first;
  CHECK(lacey_index(places, is_first, 1.) == Approx(index).epsilon(1e-12));
}

TEST_CASE("Lacey's index is refused where it says nothing")
{
  const std::vector<Vec3> places = in_cells({1, 1, 1});
  const std::vector<std::uint8_t> mixed{1, 0, 1}, alike{1, 1, 1};
  CHECK_THROWS_AS(lacey_index(places, mixed, 1.), ConfigError);
  CHECK_THROWS_AS(lacey_index(places, alike, 4.), ConfigError);
  CHECK_THROWS_AS(lacey_index(places, mixed, 0.), ConfigError);
  CHECK_NOTHROW(lacey_index(places, mixed, 2.));
}
