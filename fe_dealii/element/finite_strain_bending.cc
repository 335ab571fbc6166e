#include "fe_dealii/element/finite_strain_bending.h"

#include "dem/core/error.h"

#include <Eigen/Core>

#include <cassert>
#include <cmath>

namespace bergamo::fe
{

using namespace bending;

namespace
{

template <class Real>
struct Response
{
  Real energy; ///< [J]
  Real ratio;  ///< det F̄
};

template <class Real>
BERGAMO_INLINE Tensor3<Real> deformation_gradient(const Motion<Real> &motion)
{
  Tensor3<Real> f = motion.gradient;
  for (int i = 0; i < 3; ++i)
    f[i][i] += 1.;
  return f;
}

/// F̄ᵀ times each amplitude.
template <class Real>
BERGAMO_INLINE void draw_back(const Tensor3<Real> &f, const Real (&amplitude)[n_modes][3], Real (&result)[n_modes][3])
{
  for (int mode = 0; mode < n_modes; ++mode)
    for (int j = 0; j < 3; ++j)
      result[mode][j] = f[0][j] * amplitude[mode][0] + f[1][j] * amplitude[mode][1] + f[2][j] * amplitude[mode][2];
}

/// Adds what forces on the amplitudes drawn back do on the gradient, amplitude ⊗ force, and on the amplitudes, f force.
template <class Real>
BERGAMO_INLINE void add_works(const Tensor3<Real> &f, const Real (&amplitude)[n_modes][3],
                              const Real (&force)[n_modes][3], Tensor3<Real> &on_gradient,
                              Real (&on_amplitude)[n_modes][3])
{
  for (int mode = 0; mode < n_modes; ++mode)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        on_gradient[i][j] += amplitude[mode][i] * force[mode][j];
        on_amplitude[mode][i] += f[i][j] * force[mode][j];
      }
}

/// The derivative of the energy by the displacements. @param u 3*node + component [m]; @param force the same order [N]
template <class Law, class Real>
Response<Real> internal_force(const Law &law, const Geometry<Real> &geometry, const Real (&u)[n_dofs],
                              Real (&force)[n_dofs])
{
  const Motion<Real> motion = motion_of(geometry, u);
  const Tensor3<Real> f = deformation_gradient(motion), minors = cofactor(f);
  const Real ratio = determinant(f, minors);
  const PointResponse<Real> of_law = law.respond(f, minors, ratio);
  const VolumetricEnergy volumetric = law.volumetric();
  const Real pressure = volumetric.pressure(ratio);

  Real drawn_back[n_modes][3], on_drawn_back[n_modes][3], on_amplitude[n_modes][3];
  draw_back(f, motion.amplitude, drawn_back);
  const Real energy = hourglass_force(geometry, drawn_back, on_drawn_back);
  Tensor3<Real> on_gradient;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
      on_gradient[i][j] = geometry.volume * (of_law.stress[i][j] + pressure * minors[i][j]);
    for (int mode = 0; mode < n_modes; ++mode)
      on_amplitude[mode][i] = Real(0.);
  }
  add_works(f, motion.amplitude, on_drawn_back, on_gradient, on_amplitude);
  nodal_force(geometry, on_gradient, on_amplitude, force);
  return {energy + geometry.volume * (of_law.energy + volumetric.energy(ratio)), ratio};
}

/// Derivatives of the first Piola-Kirchhoff stress of the part W by the deformation gradient, 3*row + column, by
/// central differences: to about 1e-10 of the shear modulus [Pa].
template <class Law>
Eigen::Matrix<double, 9, 9> moduli_of(const Law &law, const Tensor3<double> &f)
{
  constexpr double step = 1e-5;
  const auto stress_at = [&](const Tensor3<double> &at)
  {
    const Tensor3<double> minors = cofactor(at);
    const Tensor3<double> stress = law.respond(at, minors, determinant(at, minors)).stress;
    return Eigen::Matrix<double, 9, 1>(&stress.at[0][0]);
  };
  Eigen::Matrix<double, 9, 9> moduli;
  for (int k = 0; k < 9; ++k)
  {
    Tensor3<double> more = f, less = f;
    more[k / 3][k % 3] += step;
    less[k / 3][k % 3] -= step;
    moduli.col(k) = (stress_at(more) - stress_at(less)) / (2 * step);
  }
  return 0.5 * (moduli + moduli.transpose());
}

/// Derivative of internal_force(), row-major [N/m]. What may be much stiffer than a bending beam, the volume, is exact:
/// differences of the forces would hide the beam.
template <class Law>
void tangent_stiffness(const Law &law, const Geometry<double> &geometry, const double (&u)[n_dofs], double *stiffness)
{
  const Motion<double> motion = motion_of(geometry, u);
  const Tensor3<double> f = deformation_gradient(motion), minors = cofactor(f);
  const double ratio = determinant(f, minors);
  const VolumetricEnergy volumetric = law.volumetric();
  const double pressure = volumetric.pressure(ratio), slope = volumetric.slope(ratio);
  const Eigen::Matrix<double, 9, 9> moduli = moduli_of(law, f);
  double drawn_back[n_modes][3], on_drawn_back[n_modes][3];
  draw_back(f, motion.amplitude, drawn_back);
  hourglass_force(geometry, drawn_back, on_drawn_back);
  for (int column = 0; column < n_dofs; ++column)
  {
    double unit[n_dofs] = {};
    unit[column] = 1;
    const Motion<double> change = motion_of(geometry, unit);
    Tensor3<double> more = f, less = f;
    double ratio_change = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
      {
        more[i][j] += change.gradient[i][j];
        less[i][j] -= change.gradient[i][j];
        ratio_change += minors[i][j] * change.gradient[i][j];
      }
    const Tensor3<double> more_minors = cofactor(more), less_minors = cofactor(less); // quadratic: no error
    const Eigen::Matrix<double, 9, 1> of_law =
        moduli * Eigen::Map<const Eigen::Matrix<double, 9, 1>>(&change.gradient.at[0][0]);
    Tensor3<double> on_gradient;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        on_gradient[i][j] = geometry.volume * (of_law[3 * i + j] + slope * ratio_change * minors[i][j] +
                                               0.5 * pressure * (more_minors[i][j] - less_minors[i][j]));
    double first[n_modes][3], second[n_modes][3], on_change[n_modes][3], on_amplitude[n_modes][3] = {};
    draw_back(f, change.amplitude, first);
    draw_back(change.gradient, motion.amplitude, second);
    for (int mode = 0; mode < n_modes; ++mode)
      for (int i = 0; i < 3; ++i)
        first[mode][i] += second[mode][i];
    hourglass_force(geometry, first, on_change);
    add_works(f, motion.amplitude, on_change, on_gradient, on_amplitude);
    add_works(change.gradient, change.amplitude, on_drawn_back, on_gradient, on_amplitude);
    double force[n_dofs];
    nodal_force(geometry, on_gradient, on_amplitude, force);
    for (int row = 0; row < n_dofs; ++row)
      stiffness[n_dofs * row + column] = force[row];
  }
}

/// Least Jacobian determinant of the present places at the points of 2×2×2, over eight [m³].
/// @param place of the nodes, 3*node + component [m]
Points least_jacobian(const Points (&place)[n_dofs])
{
  constexpr double near = 0.78867513459481288225, far = 0.21132486540518711775;
  Points edge[3][2][2][3]; // along an axis, at the points of the two others
  for (int axis = 0; axis < 3; ++axis)
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        for (int i = 0; i < 3; ++i)
        {
          const auto along = [&](const int a, const int b)
          {
            const int start = a << ((axis + 1) % 3) | b << ((axis + 2) % 3);
            return Points(place[3 * (start | 1 << axis) + i] - place[3 * start + i]);
          };
          const double at_a[2] = {p ? far : near, p ? near : far}, at_b[2] = {q ? far : near, q ? near : far};
          edge[axis][p][q][i] = at_a[0] * (at_b[0] * along(0, 0) + at_b[1] * along(0, 1)) +
                                at_a[1] * (at_b[0] * along(1, 0) + at_b[1] * along(1, 1));
        }
  Points result(HUGE_VAL);
  for (int point = 0; point < n_points; ++point)
  {
    Tensor3<Points> jacobian;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < 3; ++i)
        jacobian[i][axis] = edge[axis][(point >> ((axis + 1) % 3)) & 1][(point >> ((axis + 2) % 3)) & 1][i];
    const Points determinant_here = determinant(jacobian, cofactor(jacobian));
    result = math::select(determinant_here < result, determinant_here, result);
  }
  return result;
}

} // namespace

template <class Law>
FiniteStrainBending<Law>::FiniteStrainBending(const Law &law, std::vector<unsigned int> nodes,
                                              std::vector<Corners> corners)
    : ElementGroup(n_nodes, std::move(nodes)), law_(law),
      elements_(this->nodes(), std::move(corners), {law.bulk_modulus(), law.shear_modulus()}),
      place_(n_dofs * elements_.n_packs()), energy_(elements_.size(), 0.)
{
  for (std::size_t pack = 0; pack < elements_.n_packs(); ++pack)
    for (int k = 0; k < n_dofs; ++k)
      for (int lane = 0; lane < points_per_pack; ++lane)
        place_[n_dofs * pack + k][lane] =
            elements_.corners(points_per_pack * pack + std::min(lane, elements_.n_lanes(pack) - 1))[k / 3][k % 3];
}

template <class Law>
std::optional<std::size_t> FiniteStrainBending<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                    const double *displacement, const double *)
{
  assert(begin % points_per_pack == 0);
  for (std::size_t pack = begin / points_per_pack; points_per_pack * pack < end; ++pack)
  {
    const std::size_t first = points_per_pack * pack;
    const int n_lanes = elements_.n_lanes(pack);
    Points u[n_dofs], force[n_dofs];
    elements_.gather(pack, displacement, u);
    const Response<Points> response = internal_force(law_, elements_.pack(pack), u, force);
    for (int k = 0; k < n_dofs; ++k)
      u[k] += place_[n_dofs * pack + k];
    const Points jacobian = least_jacobian(u);
    double unused[n_dofs];
    const auto is_moving = [&](const int lane) { return lane < n_lanes && !is_rigid(first + lane); };
    scatter(force, [&](const int lane) { return is_moving(lane) ? this->force(first + lane) : unused; });
    for (int lane = 0; lane < n_lanes; ++lane)
    {
      if (!is_moving(lane))
        continue;
      energy_[first + lane] = response.energy[lane];
      // Points without a number are none that has turned: the forces have none then either.
      if (response.ratio[lane] <= 0 || jacobian[lane] <= 0)
        return first + lane;
    }
  }
  return std::nullopt;
}

template <class Law>
void FiniteStrainBending<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = law_.density() * elements_.node_volume(element)[node];
}

template <class Law>
void FiniteStrainBending<Law>::stiffness(const std::size_t element, const double *displacement, double *matrix) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  tangent_stiffness(law_, elements_.geometry(element), u, matrix);
}

template <class Law>
void FiniteStrainBending<Law>::set_share(std::span<const double>)
{
  throw ConfigError("continuum: a two-scale model shares no body of large strain; choose a linear elastic or a "
                    "Mohr-Coulomb material");
}

template <class Law>
ElementState FiniteStrainBending<Law>::state_of(const std::size_t element, const double *displacement) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  const Tensor3<double> f = deformation_gradient(motion_of(elements_.geometry(element), u));
  const Tensor3<double> piola = first_piola(law_, f);
  const double ratio = determinant(f, cofactor(f));
  ElementState state;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c)
    for (int k = 0; k < 3; ++k)
      state.stress[c] += piola[row[c]][k] * f[column[c]][k] / ratio;
  state.volume = ratio * volume(element);
  state.energy_density = energy_[element] / volume(element);
  return state;
}

template <class Law>
double FiniteStrainBending<Law>::elastic_energy() const
{
  double energy = 0;
  for (const double e : energy_)
    energy += e;
  return energy;
}

template class FiniteStrainBending<NeoHooke>;
template class FiniteStrainBending<MooneyRivlin>;
template class FiniteStrainBending<Ogden>;

} // namespace bergamo::fe
