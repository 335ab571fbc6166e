#include "fe_dealii/element/small_strain_bending.h"

#include "fe_dealii/element/hourglass_flow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace bergamo::fe
{

using namespace bending;

namespace
{

/// Copies lanes of all numbers of a struct of Points.
template <class Struct>
void copy_lane(const int lane, const Struct &from, Struct &to)
{
  constexpr std::size_t n = sizeof(Struct) / sizeof(Points);
  static_assert(n * sizeof(Points) == sizeof(Struct));
  const auto *const source = reinterpret_cast<const Points *>(&from);
  auto *const target = reinterpret_cast<Points *>(&to);
  for (std::size_t k = 0; k < n; ++k)
    target[k][lane] = source[k][lane];
}

/// Of the eight points of each element their mean, an element a lane. Elements that fill up are like the last one.
template <class History>
std::vector<History> means_of(const std::vector<History> &points, const std::vector<Corners> &corners)
{
  constexpr std::size_t n_numbers = sizeof(History) / sizeof(Points);
  std::vector<History> result((points.size() + points_per_pack - 1) / points_per_pack, History{});
  for (std::size_t slot = 0; slot < points_per_pack * result.size(); ++slot)
  {
    const std::size_t element = std::min(slot, points.size() - 1);
    const GaussPoints gauss(corners[element]);
    const double volume = std::accumulate(std::begin(gauss.weight), std::end(gauss.weight), 0.);
    const auto *const source = reinterpret_cast<const Points *>(&points[element]);
    auto *const target = reinterpret_cast<Points *>(&result[slot / points_per_pack]);
    for (std::size_t k = 0; k < n_numbers; ++k)
    {
      double mean = 0;
      for (int point = 0; point < n_points; ++point)
        mean += gauss.weight[point] / volume * source[k][point];
      target[k][slot % points_per_pack] = mean;
    }
  }
  return result;
}

bool is_uniform(const std::array<Stress, n_points> &stress)
{
  constexpr double rounding = 1e-13;
  double greatest = 0, spread = 0;
  for (const Stress &at_point : stress)
    for (int i = 0; i < 6; ++i)
    {
      greatest = std::max(greatest, std::abs(at_point[i]));
      spread = std::max(spread, std::abs(at_point[i] - stress.front()[i]));
    }
  return spread <= rounding * greatest;
}

Points dot(const Points (&a)[n_modes][3], const Points (&b)[n_modes][3])
{
  Points sum(0.);
  for (int mode = 0; mode < n_modes; ++mode)
    for (int i = 0; i < 3; ++i)
      sum += a[mode][i] * b[mode][i];
  return sum;
}

/// Adds to a column of the stiffness what the motion of a unit displacement does.
/// @param moduli of the mean strain [Pa]; @param factor of the hourglass stiffness
void unit_force(const Geometry<double> &geometry, const Moduli &moduli, const double factor, const double (&u)[n_dofs],
                double (&force)[n_dofs])
{
  const Motion<double> motion = motion_of(geometry, u);
  double strain[6], stress[6], hourglass[n_modes][3];
  small_strain(motion.gradient, strain);
  for (int i = 0; i < 6; ++i)
  {
    stress[i] = 0;
    for (int j = 0; j < 6; ++j)
      stress[i] += moduli[i][j] * strain[j];
  }
  hourglass_force(geometry, motion.amplitude, hourglass);
  for (auto &mode : hourglass)
    for (double &component : mode)
      component *= factor;
  nodal_force(geometry, work_on_gradient(geometry, stress), hourglass, force);
}

/// Row-major 24×24 [N/m]; see unit_force().
void stiffness_matrix(const Geometry<double> &geometry, const Moduli &moduli, const double factor, double *matrix)
{
  for (int column = 0; column < n_dofs; ++column)
  {
    double unit[n_dofs] = {}, force[n_dofs];
    unit[column] = 1;
    unit_force(geometry, moduli, factor, unit, force);
    for (int row = 0; row < n_dofs; ++row)
      matrix[n_dofs * row + column] = force[row];
  }
}

/// How the share that flow leaves of the hourglass forces changes with the strain.
struct KeptShare
{
  double value = 1;
  Strain slope{}; // by the strain increment
};

/// A stress xx yy zz xy yz zx and its derivative by the strain increment [Pa].
struct Varying
{
  double value[6];
  Moduli slope;

  Varying(const Stress &stress, const Moduli &slope) : slope(slope) { std::copy(stress.begin(), stress.end(), value); }
};

/// @param stiffness factor of the law's elastic moduli
template <class Law>
Varying trial_of(const Law &law, const Stress &before, const Strain &increment, const double stiffness)
{
  Varying trial(before, isotropic_moduli(law.lame_modulus(), law.shear_modulus()));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
    {
      trial.slope[i][j] *= stiffness;
      trial.value[i] += trial.slope[i][j] * increment[j];
    }
  return trial;
}

/// Of deviators the slopes may have a mean, which does nothing.
KeptShare kept_share_of(const Varying &kept, const Varying &of)
{
  KeptShare share{kept_share(kept.value, of.value), {}};
  if (share.value <= 0 || share.value >= 1)
    return share;
  double square = 0;
  for (int i = 0; i < 6; ++i)
    square += (i < 3 ? 1 : 2) * of.value[i] * of.value[i];
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      share.slope[j] +=
          (i < 3 ? 1 : 2) / square *
          (kept.slope[i][j] * of.value[i] + of.slope[i][j] * (kept.value[i] - 2 * share.value * of.value[i]));
  return share;
}

struct HardenedStress
{
  Stress stress;
  double plastic_strain;
};

/// As hourglass_step() has it. @param moduli derivative of the stress after the increment [Pa]
KeptShare kept_share_of(const MohrCoulomb &law, const HardenedStress &before, const Strain &increment,
                        const double stiffness, const Moduli &moduli)
{
  const StressUpdate update = law.update(before.stress, increment, before.plastic_strain);
  if (update.sector == Sector::elastic)
    return {};
  Varying kept(update.stress, moduli), trial = trial_of(law, before.stress, increment, stiffness);
  take_off_mean(kept.value);
  take_off_mean(trial.value);
  return kept_share_of(kept, trial);
}

KeptShare kept_share_of(const HypoplasticSand &law, const SandState &before, const Strain &increment,
                        const double stiffness, const Moduli &moduli)
{
  return kept_share_of({update(law, before, increment).state.stress, moduli},
                       trial_of(law, before.stress, increment, stiffness));
}

} // namespace

template <class Law>
SmallStrainBending<Law>::SmallStrainBending(const Law &law, std::vector<unsigned int> nodes,
                                            std::vector<Corners> corners, const std::vector<History> &start)
    : SmallStrainElements<Law>(law, n_nodes, std::move(nodes), means_of(start, corners), 1),
      elements_(this->nodes(), std::move(corners), {law.bulk_modulus(), law.shear_modulus()}),
      hourglass_(elements_.n_packs(), Modes{}), start_stress_(elements_.size())
{
  bool is_even = true;
  for (std::size_t e = 0; e < elements_.size(); ++e)
  {
    for (int point = 0; point < n_points; ++point)
      for (int i = 0; i < 6; ++i)
        start_stress_[e][point][i] = start[e].stress[i][point];
    is_even &= is_uniform(start_stress_[e]);
  }
  if (is_even)
    start_stress_ = {};
  find_start_force();
}

template <class Law>
void SmallStrainBending<Law>::find_start_force()
{
  if (start_stress_.empty())
    return;
  std::vector<double> force(n_dofs * elements_.size());
  for (std::size_t e = 0; e < elements_.size(); ++e)
  {
    const GaussPoints gauss(elements_.corners(e));
    const Geometry<double> geometry = elements_.geometry(e);
    double mean[6] = {}, volume = 0;
    for (int point = 0; point < n_points; ++point)
    {
      volume += gauss.weight[point];
      for (int i = 0; i < 6; ++i)
        mean[i] += gauss.weight[point] * start_stress_[e][point][i];
    }
    for (double &component : mean)
      component /= volume;
    double of_mean[n_dofs], none[n_modes][3] = {};
    nodal_force(geometry, work_on_gradient(geometry, mean), none, of_mean);
    const std::array<double, n_points> share = elements_.share(e);
    for (int node = 0; node < n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
      {
        constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
        double of_points = 0;
        for (int point = 0; point < n_points; ++point)
          for (int j = 0; j < 3; ++j)
            of_points += gauss.weight[point] * share[point] * start_stress_[e][point][component[i][j]] *
                         gauss.gradient[point][node][j];
        force[n_dofs * e + 3 * node + i] = of_points - of_mean[3 * node + i];
      }
  }
  start_force_ = StartForce(std::move(force), n_dofs);
}

template <class Law>
std::optional<std::size_t> SmallStrainBending<Law>::compute_forces(const std::size_t begin, const std::size_t end,
                                                                   const double *displacement, const double *before)
{
  assert(begin % points_per_pack == 0);
  for (std::size_t pack = begin / points_per_pack; points_per_pack * pack < end; ++pack)
  {
    const std::size_t first = points_per_pack * pack;
    const Geometry<Points> &geometry = elements_.pack(pack);
    Points u[n_dofs], u_before[n_dofs];
    elements_.gather(pack, displacement, u);
    elements_.gather(pack, before, u_before);
    for (int k = 0; k < n_dofs; ++k)
      u[k] -= u_before[k];
    const Motion<Points> motion = motion_of(geometry, u);
    Points strain[6];
    small_strain(motion.gradient, strain);

    History &history = this->history(pack);
    const History history_before = history;
    const Modes modes_before = hourglass_[pack];
    const bool all_followed = update_stress(this->law(), geometry.volume, strain, history, this->reports(pack));
    Amplitudes on_amplitude;
    move_hourglass(pack, history_before, strain, motion.amplitude, on_amplitude);
    Points force[n_dofs];
    nodal_force(geometry, work_on_gradient(geometry, history.stress), on_amplitude, force);

    const int n_lanes = elements_.n_lanes(pack);
    double unused[n_dofs];
    const auto is_moving = [&](const int lane) { return lane < n_lanes && !this->is_rigid(first + lane); };
    scatter(force, [&](const int lane) { return is_moving(lane) ? this->force(first + lane) : unused; });
    keep_rigid(pack, history_before, modes_before);
    if (!start_force_.is_empty())
      for (int lane = 0; lane < n_lanes; ++lane)
        if (is_moving(lane))
        {
          double of_element[n_dofs];
          this->gather(first + lane, displacement, of_element);
          start_force_.add(first + lane, of_element, this->force(first + lane));
        }
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
      if (!all_followed)
        for (int lane = 0; lane < n_lanes; ++lane)
          if (is_moving(lane) && this->reports(pack)[lane] != SandUpdateStatus::done)
            return first + lane;
  }
  return std::nullopt;
}

template <class Law>
void SmallStrainBending<Law>::move_hourglass(const std::size_t pack, const History &before, const Points (&strain)[6],
                                             const Amplitudes &increment, Amplitudes &force)
{
  const Geometry<Points> &geometry = elements_.pack(pack);
  Amplitudes &elastic = hourglass_[pack].elastic;
  if constexpr (std::is_same_v<Law, LinearElastic>)
  {
    for (int mode = 0; mode < n_modes; ++mode)
      for (int i = 0; i < 3; ++i)
        elastic[mode][i] += increment[mode][i];
    hourglass_force(geometry, elastic, force);
  }
  else
  {
    History &after = this->history(pack);
    const HourglassStep step = hourglass_step(this->law(), before, strain, after, this->reports(pack));
    Amplitudes middle, lost; // twice the mean of the step; what flow takes
    for (int mode = 0; mode < n_modes; ++mode)
      for (int i = 0; i < 3; ++i)
      {
        const Points trial = elastic[mode][i] + step.stiffness * increment[mode][i];
        middle[mode][i] = elastic[mode][i];
        elastic[mode][i] = step.kept * trial;
        middle[mode][i] += elastic[mode][i];
        lost[mode][i] = trial - elastic[mode][i];
      }
    const Points energy = hourglass_force(geometry, elastic, force);
    Amplitudes twice_mean_force;
    if constexpr (std::is_same_v<Law, HypoplasticSand>)
    {
      hourglass_force(geometry, middle, twice_mean_force);
      after.dissipated_energy += 0.5 * dot(twice_mean_force, increment);
    }
    else
    {
      const bool some_flow = math::any(step.kept < 1.), stiffens = this->law().depends_on_pressure();
      if (!some_flow && !stiffens)
        return;
      hourglass_force(geometry, middle, twice_mean_force);
      const Points dissipated = 0.5 * dot(twice_mean_force, lost) / step.stiffness;
      after.dissipated_energy += dissipated;
      if (!stiffens)
        return;
      Amplitudes old;
      for (int mode = 0; mode < n_modes; ++mode)
        for (int i = 0; i < 3; ++i)
          old[mode][i] = middle[mode][i] - elastic[mode][i];
      Amplitudes unused;
      const Points energy_before = hourglass_force(geometry, old, unused) * softness(before);
      after.stiffness_loss +=
          0.5 * dot(twice_mean_force, increment) - dissipated - (energy * softness(after) - energy_before);
    }
  }
}

template <class Law>
void SmallStrainBending<Law>::keep_rigid(const std::size_t pack, const History &before, const Modes &modes_before)
{
  for (int lane = 0; lane < elements_.n_lanes(pack); ++lane)
    if (this->is_rigid(points_per_pack * pack + lane))
    {
      copy_lane(lane, before, this->history(pack));
      copy_lane(lane, modes_before, hourglass_[pack]);
    }
}

template <class Law>
Points SmallStrainBending<Law>::softness(const History &history) const
{
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    if (this->law().depends_on_pressure())
      return 1. / this->law().stiffness_factor(invariants_of(history.stress).mean);
  return Points(1.);
}

template <class Law>
double SmallStrainBending<Law>::hourglass_energy(const std::size_t element) const
{
  if constexpr (std::is_same_v<Law, HypoplasticSand>)
    return 0;
  const std::size_t pack = element / points_per_pack, lane = element % points_per_pack;
  double amplitude[n_modes][3], unused[n_modes][3];
  for (int mode = 0; mode < n_modes; ++mode)
    for (int i = 0; i < 3; ++i)
      amplitude[mode][i] = hourglass_[pack].elastic[mode][i][lane];
  return hourglass_force(elements_.geometry(element), amplitude, unused) * softness(this->history(pack))[lane];
}

template <class Law>
double SmallStrainBending<Law>::elastic_energy() const
{
  double energy = SmallStrainElements<Law>::elastic_energy();
  for (std::size_t e = 0; e < elements_.size(); ++e)
    energy += hourglass_energy(e);
  for (const double of_start : start_force_.energy())
    energy += of_start;
  return energy;
}

template <class Law>
ElementState SmallStrainBending<Law>::state_of(const std::size_t element, const double *displacement) const
{
  ElementState state = SmallStrainElements<Law>::state_of(element, displacement);
  if (const double share_volume = point_share_volume(element, 0); share_volume > 0)
    state.energy_density += hourglass_energy(element) / share_volume;
  return state;
}

template <class Law>
std::vector<std::pair<std::string, std::span<double>>> SmallStrainBending<Law>::state()
{
  static_assert(sizeof(Modes) % sizeof(double) == 0);
  auto views = SmallStrainElements<Law>::state();
  views.push_back(
      {"element_hourglass",
       {reinterpret_cast<double *>(hourglass_.data()), hourglass_.size() * sizeof(Modes) / sizeof(double)}});
  views.push_back({"element_start_energy", start_force_.energy()});
  return views;
}

template <class Law>
void SmallStrainBending<Law>::lumped_mass(const std::size_t element, double *mass) const
{
  for (int node = 0; node < n_nodes; ++node)
    mass[node] = this->law().density() * elements_.node_volume(element)[node];
}

template <class Law>
void SmallStrainBending<Law>::stiffness(const std::size_t element, const double *, double *matrix) const
{
  const double factor = this->stiffness_factor(element);
  Moduli moduli = isotropic_moduli(this->law().lame_modulus(), this->law().shear_modulus());
  for (auto &row : moduli)
    for (double &modulus : row)
      modulus *= factor;
  stiffness_matrix(elements_.geometry(element), moduli, factor, matrix);
}

template <class Law>
void SmallStrainBending<Law>::tangent(const std::size_t element, const double *displacement, const double *before,
                                      double *matrix) const
{
  double increment[n_dofs];
  this->gather_increment(element, displacement, before, increment);
  const Geometry<double> geometry = elements_.geometry(element);
  const Motion<double> motion = motion_of(geometry, increment);
  double components[6];
  small_strain(motion.gradient, components);
  Strain strain;
  std::copy(std::begin(components), std::end(components), strain.begin());
  const double factor = this->stiffness_factor(element);
  const Moduli moduli = this->tangent_moduli(element, 0, strain);
  const std::size_t pack = element / points_per_pack, lane = element % points_per_pack;
  KeptShare kept;
  if constexpr (std::is_same_v<Law, MohrCoulomb>)
    kept =
        kept_share_of(this->law(), HardenedStress{this->stress(element, 0), this->history(pack).plastic_strain[lane]},
                      strain, factor, moduli);
  else if constexpr (std::is_same_v<Law, HypoplasticSand>)
    kept = kept_share_of(this->law(), sand_state(this->history(pack), lane), strain, factor, moduli);
  stiffness_matrix(geometry, moduli, kept.value * factor, matrix);

  // What the strain does through the share that flow leaves: forces of the modes at their trial times its slope.
  double trial[n_modes][3], of_trial[n_modes][3], force[n_dofs], slope[n_dofs], on_slope[6];
  for (int mode = 0; mode < n_modes; ++mode)
    for (int i = 0; i < 3; ++i)
      trial[mode][i] = hourglass_[pack].elastic[mode][i][lane] + factor * motion.amplitude[mode][i];
  hourglass_force(geometry, trial, of_trial);
  nodal_force(geometry, Tensor3<double>{}, of_trial, force);
  std::copy(kept.slope.begin(), kept.slope.end(), on_slope);
  const double none[n_modes][3] = {};
  nodal_force(geometry, work_on_gradient(geometry, on_slope), none, slope);
  if (geometry.volume > 0)
    for (int row = 0; row < n_dofs; ++row)
      for (int column = 0; column < n_dofs; ++column)
        matrix[n_dofs * row + column] += force[row] * slope[column] / geometry.volume;
}

template <class Law>
bool SmallStrainBending<Law>::has_symmetric_tangent() const
{
  return std::is_same_v<Law, LinearElastic>; // how the hourglass forces fade is no gradient
}

template <class Law>
void SmallStrainBending<Law>::set_share(const std::span<const double> nodal_share)
{
  elements_.set_share(nodal_share);
  find_start_force();
}

template class SmallStrainBending<LinearElastic>;
template class SmallStrainBending<MohrCoulomb>;
template class SmallStrainBending<HypoplasticSand>;

} // namespace bergamo::fe
