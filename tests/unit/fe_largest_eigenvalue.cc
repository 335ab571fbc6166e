#include "fe_dealii/element/element_group.h"
#include "fe_dealii/element/largest_eigenvalue.h"

#include <catch2/catch.hpp>

#include <array>

using namespace bergamo::fe;

namespace
{

/// One node of mass 2 kg with a stiffness of given principal values, turned out of the axes.
class Spring final : public ElementGroup
{
public:
  explicit Spring(const std::array<double, 3> &principal) : ElementGroup(1, {0}), principal(principal) {}

  void stiffness(std::size_t, const double *, double *matrix) const override
  {
    constexpr double direction[3][3] = {{2. / 3, 2. / 3, 1. / 3}, {-2. / 3, 1. / 3, 2. / 3}, {1. / 3, -2. / 3, 2. / 3}};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        matrix[3 * i + j] = 0;
        for (int k = 0; k < 3; ++k)
          matrix[3 * i + j] += principal[k] * direction[k][i] * direction[k][j];
      }
  }
  void lumped_mass(std::size_t, double *mass) const override { mass[0] = 2; }

  std::optional<std::size_t> compute_forces(std::size_t, std::size_t, const double *, const double *) override
  {
    return std::nullopt;
  }
  void tangent(std::size_t, const double *, const double *, double *) const override {}
  void set_share(std::span<const double>) override {}
  double volume(std::size_t) const override { return 1; }
  ElementState state_of(std::size_t, const double *) const override { return {}; }
  double elastic_energy() const override { return 0; }
  double dissipated_energy() const override { return 0; }
  std::vector<std::pair<std::string, std::span<double>>> state() override { return {}; }

private:
  std::array<double, 3> principal;
};

} // namespace

TEST_CASE("the bound on an element's eigenvalues is tight whatever their signs", "[fe]")
{
  const std::array<double, 3> principals[] = {{8, 3, 1},   {8, 8, 8},      {8, 0, 0},      {1, -8, 0.5},
                                              {8, -7, -1}, {8, -7.999, 0}, {-8, -2, 1e-9}, {7.999, -8, 8}};
  for (const auto &principal : principals)
  {
    CAPTURE(principal[0], principal[1], principal[2]);
    const double bound = largest_eigenvalue(Spring(principal), 0, nullptr);
    CHECK(bound >= 4);
    CHECK(bound <= 4 * 1.004);
  }
  CHECK(largest_eigenvalue(Spring({0, 0, 0}), 0, nullptr) == 0);
}
