#pragma once

#include <cstdint>
#include <vector>

namespace bergamo::dem
{

/// Elastic material of grains or walls.
struct Material
{
  double young_modulus = 50e9; ///< [Pa]
  double poisson_ratio = 0.2;
  double density = 2650.; ///< [kg/m^3]

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// How two materials rub and lose energy where they touch.
struct SurfacePair
{
  double friction = 0.24; ///< Coulomb's coefficient
  double damping_ratio =
      0.9; ///< dashpot, share of critical damping; see damping_ratio_of() for a restitution coefficient
  double relaxation_time = 0.; ///< A of the viscoelastic law, beside the dashpot [s]; see relaxation_time()

  /// Throws ConfigError for a value out of its range.
  void validate() const;
};

/// The materials of a simulation, by number, and what is between any two of them.
class MaterialTable
{
public:
  MaterialTable() = default;
  explicit MaterialTable(const std::vector<Material> &materials);

  /// @return its number
  std::int32_t add(const Material &material);

  std::int32_t size() const { return static_cast<std::int32_t>(materials.size()); }
  Material &operator[](const std::int32_t number) { return materials.at(number); }
  const Material &operator[](const std::int32_t number) const { return materials.at(number); }

  /// The same in either order. Throws ConfigError for a number that the table lacks.
  SurfacePair &between(std::int32_t first, std::int32_t second);
  const SurfacePair &between(std::int32_t first, std::int32_t second) const;

  std::vector<SurfacePair> &surface_pairs() { return pairs; } ///< by pair_number()
  const std::vector<SurfacePair> &surface_pairs() const { return pairs; }
  std::int32_t n_pairs() const { return static_cast<std::int32_t>(pairs.size()); }

  /// Pairs in one row: (0,0), (0,1), (1,1), (0,2) ..
  static std::int32_t pair_number(const std::int32_t first, const std::int32_t second)
  {
    const std::int32_t low = first < second ? first : second, high = first < second ? second : first;
    return high * (high + 1) / 2 + low;
  }

  /// Throws ConfigError for a value out of its range.
  void validate() const;

private:
  std::vector<Material> materials;
  std::vector<SurfacePair> pairs; // by pair_number()
};

} // namespace bergamo::dem
