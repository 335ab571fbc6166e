#include "fe_dealii/material/hypoplastic_integration.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

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

} // namespace

SandUpdate update(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                  const SubstepControl &control)
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

std::string explain(const SandUpdate &failed, const Strain &increment)
{
  std::ostringstream text;
  text << "a stress of xx " << failed.state.stress[0] << " yy " << failed.state.stress[1] << " zz "
       << failed.state.stress[2] << " xy " << failed.state.stress[3] << " yz " << failed.state.stress[4] << " zx "
       << failed.state.stress[5] << " Pa and a void ratio of " << failed.state.void_ratio
       << ", which cannot follow a strain increment of xx " << increment[0] << " yy " << increment[1] << " zz "
       << increment[2] << " xy " << increment[3] << " yz " << increment[4] << " zx " << increment[5] << ": ";
  if (failed.status == SandUpdateStatus::no_voids)
    text << "it would leave no voids between the grains; choose a smaller load or a finer mesh there";
  else
    text << "the least substep does not keep the tolerance, after " << failed.n_substeps
         << " substeps; choose a smaller time step, or look for what is no finite number";
  return text.str();
}

} // namespace bergamo::fe
