#include "fe_dealii/material/hypoplastic_integration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

namespace bergamo::fe
{
namespace
{

/// The path of constant D over an increment, from 0 to 1.
struct StrainPath
{
  const HypoplasticSand &sand;
  const Strain &increment;
  double start_void_ratio;
  double volume_strain = increment[0] + increment[1] + increment[2];

  double void_ratio(const double at) const
  {
    return start_void_ratio + (1 + start_void_ratio) * std::expm1(at * volume_strain);
  }
  /// Derivative of the stress by the share of the increment that is done [Pa].
  Stress slope(const double at, const Stress &stress) const
  {
    return sand.response({stress, void_ratio(at)}).rate(increment);
  }
};

template <class... Slopes>
Stress moved(const Stress &from, const double step, const std::pair<double, const Slopes &>... part)
{
  Stress stress;
  for (int i = 0; i < 6; ++i)
    stress[i] = from[i] + step * ((part.first * part.second[i]) + ...);
  return stress;
}

struct Substep
{
  Stress stress;   // order 3
  Stress end_rate; // there, the first of the next substep
  double error;    // [Pa]
};

Substep advance(const StrainPath &path, const double at, const double step, const Stress &from, const Stress &k1)
{
  using Part = std::pair<double, const Stress &>;
  const Stress k2 = path.slope(at + 0.5 * step, moved(from, step, Part{1. / 2, k1}));
  const Stress k3 = path.slope(at + 0.75 * step, moved(from, step, Part{3. / 4, k2}));
  Substep result;
  result.stress = moved(from, step, Part{2. / 9, k1}, Part{1. / 3, k2}, Part{4. / 9, k3});
  result.end_rate = path.slope(at + step, result.stress);
  result.error = stress_norm(
      moved(Stress{}, step, Part{-5. / 72, k1}, Part{1. / 12, k2}, Part{1. / 9, k3}, Part{-1. / 8, result.end_rate}));
  return result;
}

/// The stress over substeps that are given, as shares of the increment.
Stress carried(const StrainPath &path, Stress stress, const std::vector<double> &substeps)
{
  double done = 0;
  for (const double step : substeps)
  {
    stress = advance(path, done, step, stress, path.slope(done, stress)).stress;
    cut_tension(stress);
    done += step;
  }
  return stress;
}

/// @param taken gets the substeps that are accepted, if any is given
SandUpdate update(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                  const SubstepControl &control, std::vector<double> *const taken)
{
  SandUpdate result{start, SandUpdateStatus::done, 0, 0};
  const StrainPath path{sand, increment, start.void_ratio};
  const double end_void_ratio = path.void_ratio(1);
  if (end_void_ratio <= 0)
  {
    result.status = SandUpdateStatus::no_voids;
    return result;
  }
  const double least_size = std::numbers::sqrt3 * sand.parameters().least_pressure;
  Stress stress = start.stress, slope = path.slope(0, stress);
  double done = 0, step = 1;
  while (done < 1)
  {
    const bool is_last = step >= 1 - done;
    const double size = is_last ? 1 - done : step;
    const Substep next = advance(path, done, size, stress, slope);
    const double error = next.error / std::max(stress_norm(next.stress), least_size);
    const bool is_good = error <= control.tolerance; // false for a NaN
    // The error grows as the cube of the substep; 0.9 keeps a tenth in hand.
    const double wanted = is_good || std::isfinite(error) ? 0.9 * std::cbrt(control.tolerance / error) : 0.1;
    step = size * std::clamp(wanted, 0.1, 5.);
    if (is_good)
    {
      ++result.n_substeps;
      if (taken)
        taken->push_back(size);
      done = is_last ? 1 : done + size;
      stress = next.stress;
      slope = cut_tension(stress) && done < 1 ? path.slope(done, stress) : next.end_rate;
      continue;
    }
    ++result.n_rejected;
    if (step < control.least_substep)
    {
      result.status = SandUpdateStatus::substep_too_small;
      return result;
    }
  }
  result.state = {stress, end_void_ratio};
  return result;
}

} // namespace

SandUpdate update(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                  const SubstepControl &control)
{
  return update(sand, start, increment, control, nullptr);
}

Moduli consistent_tangent(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                          const SubstepControl &control)
{
  std::vector<double> substeps;
  const double size = strain_norm(increment);
  if (size == 0 || update(sand, start, increment, control, &substeps).status != SandUpdateStatus::done)
    return sand.response(start).tangent(increment);
  // Central differences: their square of 1e-5 and the rounding of stresses over 1e-5 of an increment are both small
  // beside the error of the substeps.
  const double h = 1e-5 * size;
  Moduli moduli;
  for (int j = 0; j < 6; ++j)
  {
    Strain above = increment, below = increment;
    above[j] += h;
    below[j] -= h;
    const Stress up = carried({sand, above, start.void_ratio}, start.stress, substeps);
    const Stress down = carried({sand, below, start.void_ratio}, start.stress, substeps);
    for (int i = 0; i < 6; ++i)
      moduli[i][j] = (up[i] - down[i]) / (2 * h);
  }
  return moduli;
}

std::string explain(const SandUpdateStatus status, const SandState &state)
{
  const Stress &stress = state.stress;
  std::ostringstream text;
  text << "sand with a stress of xx " << stress[0] << " yy " << stress[1] << " zz " << stress[2] << " xy " << stress[3]
       << " yz " << stress[4] << " zx " << stress[5] << " Pa and a void ratio of " << state.void_ratio
       << " that cannot follow the strain of a step: ";
  if (status == SandUpdateStatus::no_voids)
    text << "no voids would be left between the grains; choose a smaller load or a finer mesh there";
  else
    text << "the least substep does not keep the tolerance; choose a smaller time step, or look for what is no finite "
            "number in the motion of its nodes";
  return text.str();
}

} // namespace bergamo::fe
