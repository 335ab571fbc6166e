#include "dem/core/error.h"
#include "tests/unit/fe_rubber.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace bergamo;
using namespace bergamo::fe;

namespace
{

using Matrix = Tensor3<double>;

Matrix product(const Matrix &a, const Matrix &b)
{
  Matrix result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        result[i][j] += a[i][k] * b[k][j];
  return result;
}

double norm(const Matrix &a)
{
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      sum += a[i][j] * a[i][j];
  return std::sqrt(sum);
}

double distance(Matrix a, const Matrix &b)
{
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      a[i][j] -= b[i][j];
  return norm(a);
}

Matrix diagonal(const double x, const double y, const double z)
{
  return {{{x, 0, 0}, {0, y, 0}, {0, 0, z}}};
}

Matrix random_gradient(std::mt19937_64 &random, const double size)
{
  std::uniform_real_distribution<double> change(-size, size);
  Matrix f = diagonal(1, 1, 1);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      f[i][j] += change(random);
  return f;
}

Matrix random_rotation(std::mt19937_64 &random)
{
  std::normal_distribution<double> normal;
  const PrincipalFrame<double> frame =
      principal_frame(Stress{normal(random), normal(random), normal(random), normal(random), normal(random), 1.});
  Matrix q;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      q[i][j] = frame.direction[i][j];
  if (determinant(q, cofactor(q)) < 0)
    for (int j = 0; j < 3; ++j)
      q[0][j] = -q[0][j];
  return q;
}

/// Cauchy stress of a stretch along the axes, x, y, z [Pa].
template <class Law>
std::array<double, 3> cauchy(const Law &law, const double x, const double y, const double z)
{
  const Matrix stress = first_piola(law, diagonal(x, y, z));
  return {stress[0][0] / (y * z), stress[1][1] / (z * x), stress[2][2] / (x * y)};
}

} // namespace

TEST_CASE("the stress of a hyperelastic law is the derivative of its energy")
{
  for_each_law(
      [](const auto &law)
      {
        std::mt19937_64 random(1);
        for (int trial = 0; trial < 200; ++trial)
        {
          const Matrix f = random_gradient(random, 0.3);
          if (determinant(f, cofactor(f)) < 0.3)
            continue;
          constexpr double step = 1e-5; // error of the differences 1e-10 of the moduli, of their rounding 1e-11
          Matrix slope;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
            {
              Matrix more = f, less = f;
              more[i][j] += step;
              less[i][j] -= step;
              slope[i][j] = (energy_density(law, more) - energy_density(law, less)) / (2 * step);
            }
          CHECK(distance(first_piola(law, f), slope) < 1e-7 * law.bulk_modulus());
        }
      });
}

TEST_CASE("hyperelastic laws neither see rotations nor prefer a direction")
{
  for_each_law(
      [](const auto &law)
      {
        std::mt19937_64 random(2);
        CHECK(norm(first_piola(law, random_rotation(random))) < 1e-13 * law.bulk_modulus());
        for (int trial = 0; trial < 100; ++trial)
        {
          const Matrix f = random_gradient(random, 0.3), q = random_rotation(random);
          const Matrix stress = first_piola(law, f);
          const double rounding = 1e-13 * (law.bulk_modulus() + norm(stress));
          CHECK(distance(first_piola(law, product(q, f)), product(q, stress)) < rounding);
          CHECK(distance(first_piola(law, product(f, q)), product(stress, q)) < rounding);
        }
      });
}

TEST_CASE("at small strain hyperelastic laws are Hooke's")
{
  for_each_law(
      [](const auto &law)
      {
        std::mt19937_64 random(3);
        const double k = law.bulk_modulus(), g = law.shear_modulus();
        for (const double size : {1e-4, 1e-5})
        {
          const Matrix f = random_gradient(random, size);
          const double dilatation = f[0][0] + f[1][1] + f[2][2] - 3;
          Matrix hooke;
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              hooke[i][j] = g * (f[i][j] + f[j][i] - (i == j ? 2 : 0)) + (i == j ? (k - 2 * g / 3) * dilatation : 0);
          CHECK(distance(first_piola(law, f), hooke) < 30 * k * size * size); // of second order in the strain
        }
      });
}

TEST_CASE("rubber under uniaxial, biaxial and planar stretch and under pressure")
{
  const double g = rubber.shear_modulus(), c = 0.2;
  const OgdenParameters o;
  const auto sum_of_terms = [&](const double x, const double y)
  {
    double sum = 0;
    for (int n = 0; n < 3; ++n)
      sum += o.modulus[n] * (std::pow(x, o.exponent[n]) - std::pow(y, o.exponent[n]));
    return sum;
  };
  for (const double s : {0.4, 0.8, 1.3, 3., 6.})
  {
    CAPTURE(s);
    // Differences of the principal Cauchy stresses at constant volume (Ogden, Non-linear Elastic Deformations (1984),
    // section 7.2); the mean stress is that of the volume, 0 here.
    const std::array<std::array<double, 2>, 3> stretches = {{{s, 1 / std::sqrt(s)}, {s, s}, {s, 1}}};
    for (const auto &[x, y] : stretches)
    {
      const double z = 1 / (x * y);
      const auto check = [&](const std::array<double, 3> &stress, const double expected)
      { CHECK(stress[0] - stress[2] == Approx(expected).epsilon(1e-12)); };
      const double first = x * x - z * z, second = 1 / (z * z) - 1 / (x * x);
      check(cauchy(neo_hooke(), x, y, z), g * first);
      check(cauchy(mooney_rivlin(), x, y, z), g * ((1 - c) * first + c * second));
      check(cauchy(ogden(), x, y, z), sum_of_terms(x, z));
    }
    const double j = s * s * s;
    for (const double stress : cauchy(mooney_rivlin(), s, s, s))
      CHECK(stress == Approx(rubber.bulk_modulus() / 2 * (j - 1 / j)).epsilon(1e-12));
    for (const double stress : cauchy(ogden(), s, s, s))
      CHECK(stress == Approx(o.bulk_modulus / 2 * (j - 1 / j)).epsilon(1e-12));
    const double lame = rubber.bulk_modulus() - 2 * g / 3;
    for (const double stress : cauchy(neo_hooke(), s, s, s))
      CHECK(stress == Approx(lame / 2 * (j - 1 / j) + g * (s * s - 1) / j).epsilon(1e-12));
  }
}

TEST_CASE("Ogden's law with the exponents 2 and -2 is Mooney and Rivlin's")
{
  const double g = rubber.shear_modulus();
  const Ogden two_terms({.modulus = {0.8 * g, -0.2 * g, 0},
                         .exponent = {2, -2, 1},
                         .bulk_modulus = rubber.bulk_modulus(),
                         .density = 1000});
  CHECK(two_terms.shear_modulus() == Approx(g));
  std::mt19937_64 random(4);
  for (int trial = 0; trial < 100; ++trial)
  {
    const Matrix f = random_gradient(random, 0.3);
    CHECK(distance(first_piola(two_terms, f), first_piola(mooney_rivlin(), f)) < 1e-12 * rubber.bulk_modulus());
    CHECK(energy_density(two_terms, f) == Approx(energy_density(mooney_rivlin(), f)).margin(1e-12 * g));
  }
}

TEST_CASE("a pack of points has the stresses of the points alone")
{
  using Points = bergamo::Lanes<8>;
  for_each_law(
      [](const auto &law)
      {
        std::mt19937_64 random(5);
        Tensor3<Points> pack;
        std::array<Matrix, 8> alone;
        for (int point = 0; point < 8; ++point)
        {
          alone[point] = random_gradient(random, 0.2);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              pack[i][j][point] = alone[point][i][j];
        }
        const Tensor3<Points> stress = first_piola(law, pack);
        const Points energy = energy_density(law, pack);
        for (int point = 0; point < 8; ++point)
        {
          const Matrix one = first_piola(law, alone[point]);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              CHECK(stress[i][j][point] == Approx(one[i][j]).margin(1e-12 * law.bulk_modulus()));
          CHECK(energy[point] == Approx(energy_density(law, alone[point])).margin(1e-12 * law.bulk_modulus()));
        }
      });
}

TEST_CASE("parameters that no rubber can have are refused by name")
{
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(NeoHooke({.young_modulus = -1}), Contains("Neo-Hooke") && Contains("young_modulus [Pa] = -1"));
  CHECK_THROWS_WITH(NeoHooke({.young_modulus = 1, .poisson_ratio = -0.1}), Contains("poisson_ratio = -0.1"));
  CHECK_THROWS_WITH(MooneyRivlin({.elastic = rubber, .second_share = 2}), Contains("second_share = 2"));
  CHECK_THROWS_WITH(MooneyRivlin({.elastic = {.poisson_ratio = 0.5}}), Contains("Mooney-Rivlin") && Contains("0.5"));
  CHECK_THROWS_WITH(Ogden({.modulus = {1, 1, -1}, .exponent = {2, 2, 2}}),
                    Contains("modulus times exponent [Pa] = -2"));
  CHECK_THROWS_WITH(Ogden({.modulus = {0, 0, 0}}), Contains("shear modulus"));
  CHECK_THROWS_AS(Ogden({.bulk_modulus = std::nan("")}), ConfigError);
}
