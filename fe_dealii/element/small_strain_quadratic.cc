#include "fe_dealii/element/small_strain_quadratic.h"

#include "dem/core/error.h"

namespace bergamo::fe
{
namespace
{

template <class Geometry>
void strain(const Geometry &geometry, const int pack, const double *u, Points (&result)[6])
{
  for (Points &component : result)
    component = Points{};
  for (int node = 0; node < Geometry::nodes; ++node)
  {
    const Points &dx = geometry.gradient[pack][0][node], &dy = geometry.gradient[pack][1][node],
                 &dz = geometry.gradient[pack][2][node];
    const double ux = u[3 * node], uy = u[3 * node + 1], uz = u[3 * node + 2];
    result[0] += ux * dx;
    result[1] += uy * dy;
    result[2] += uz * dz;
    result[3] += ux * dy + uy * dx;
    result[4] += uy * dz + uz * dy;
    result[5] += uz * dx + ux * dz;
  }
}

template <class Geometry>
void add_internal_force(const Geometry &geometry, const int pack, const Points (&stress)[6], double *force)
{
  Points weighted[6];
  for (int i = 0; i < 6; ++i)
    weighted[i] = geometry.volume[pack] * stress[i];
  for (int node = 0; node < Geometry::nodes; ++node)
  {
    const Points &dx = geometry.gradient[pack][0][node], &dy = geometry.gradient[pack][1][node],
                 &dz = geometry.gradient[pack][2][node];
    force[3 * node] += sum(weighted[0] * dx + weighted[3] * dy + weighted[5] * dz);
    force[3 * node + 1] += sum(weighted[3] * dx + weighted[1] * dy + weighted[4] * dz);
    force[3 * node + 2] += sum(weighted[5] * dx + weighted[4] * dy + weighted[2] * dz);
  }
}

/// Adds the stiffness of a pack's points, row-major. @param stress_of stress_of(strain, stress): linear
template <class Geometry, class StressOf>
void add_stiffness(const Geometry &geometry, const int pack, const StressOf &stress_of, double *matrix)
{
  constexpr int n = 3 * Geometry::nodes;
  for (int column = 0; column < n; ++column)
  {
    double unit[n] = {}, force[n] = {};
    unit[column] = 1;
    Points unit_strain[6], stress[6];
    strain(geometry, pack, unit, unit_strain);
    stress_of(unit_strain, stress);
    add_internal_force(geometry, pack, stress, force);
    for (int row = 0; row < n; ++row)
      matrix[n * row + column] += force[row];
  }
}

} // namespace

template <class Law>
SmallStrainQuadratic<Law>::SmallStrainQuadratic(const Law &law, std::vector<unsigned int> nodes,
                                                std::vector<Geometry> geometry, MassShares mass_shares,
                                                std::vector<typename SmallStrainElements<Law>::History> start)
    : SmallStrainElements<Law>(law, n_nodes, std::move(nodes), std::move(start), points_per_pack * n_packs),
      geometry_(std::move(geometry)), mass_shares_(std::move(mass_shares))
{
}

template <class Law>
std::optional<std::size_t> SmallStrainQuadratic<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                     const double *displacement, const double *before)
{
  for (std::size_t e = begin; e < end; ++e)
  {
    if (this->is_rigid(e))
      continue;
    double increment[3 * n_nodes];
    this->gather_increment(e, displacement, before, increment);
    double *const force = this->force(e);
    std::fill(force, force + 3 * n_nodes, 0.);
    for (int pack = 0; pack < n_packs; ++pack)
    {
      Points strain_increment[6];
      strain(geometry_[e], pack, increment, strain_increment);
      const std::size_t place = n_packs * e + pack;
      auto &history = this->history(place);
      if (!update_stress(this->law(), geometry_[e].volume[pack], strain_increment, history, this->reports(place)))
        return e;
      add_internal_force(geometry_[e], pack, history.stress, force);
    }
  }
  return std::nullopt;
}

template <class Law>
void SmallStrainQuadratic<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  const double whole = this->law().density() * geometry_[element].whole_volume();
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = whole * mass_shares_.lumped[n_nodes * element + node];
}

template <class Law>
void SmallStrainQuadratic<Law>::gravitational_mass(const std::size_t element, double *mass) const
{
  const double whole = this->law().density() * geometry_[element].whole_volume();
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = whole * mass_shares_.row_sum[n_nodes * element + node];
}

template <class Law>
void SmallStrainQuadratic<Law>::stiffness(const std::size_t element, const double *, double *matrix) const
{
  const double factor = this->stiffness_factor(element);
  std::fill(matrix, matrix + 9 * n_nodes * n_nodes, 0.);
  for (int pack = 0; pack < n_packs; ++pack)
    add_stiffness(
        geometry_[element], pack,
        [&](const Points(&unit_strain)[6], Points(&stress)[6])
        {
          elastic_stress(this->law(), unit_strain, stress);
          for (Points &component : stress)
            component *= factor;
        },
        matrix);
}

template <class Law>
void SmallStrainQuadratic<Law>::tangent(const std::size_t element, const double *displacement, const double *before,
                                        double *matrix) const
{
  double increment[3 * n_nodes];
  this->gather_increment(element, displacement, before, increment);
  std::fill(matrix, matrix + 9 * n_nodes * n_nodes, 0.);
  for (int pack = 0; pack < n_packs; ++pack)
  {
    Points strain_increment[6], moduli[6][6];
    strain(geometry_[element], pack, increment, strain_increment);
    this->tangent_moduli(element, pack, strain_increment, moduli);
    add_stiffness(
        geometry_[element], pack,
        [&](const Points(&unit_strain)[6], Points(&stress)[6]) { apply_moduli(moduli, unit_strain, stress); }, matrix);
  }
}

template <class Law>
void SmallStrainQuadratic<Law>::set_share(std::span<const double>)
{
  throw ConfigError("continuum: a two-scale model shares no elements of 27 nodes; choose degree 1");
}

template class SmallStrainQuadratic<LinearElastic>;
template class SmallStrainQuadratic<MohrCoulomb>;
template class SmallStrainQuadratic<HypoplasticSand>;

} // namespace bergamo::fe
