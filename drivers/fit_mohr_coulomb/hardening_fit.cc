#include "drivers/fit_mohr_coulomb/hardening_fit.h"

#include "drivers/fit_mohr_coulomb/least_misfit.h"

#include <algorithm>

namespace bergamo::driver
{
namespace
{

using Vector = Eigen::VectorXd;

constexpr Bounded modulus{0.05, 20};    // over that of the start, which is a secant's
constexpr Bounded exponent{0.01, 1};    // m
constexpr Bounded ratio{0.005, 0.49};   // ν
constexpr Bounded friction{2, 70};      // φ [degrees]
constexpr Bounded dilation{0.5, 1.4};   // (90° + ψ)/90°: ψ may be negative
constexpr Bounded hardening{1e-5, 0.3}; // a

fe::MohrCoulombParameters continuum_of(const Vector &x, const fe::MohrCoulombParameters &start)
{
  fe::MohrCoulombParameters continuum = start;
  continuum.young_modulus = start.young_modulus * modulus.value(x[0]);
  continuum.poisson_ratio = ratio.value(x[1]);
  continuum.friction_angle = friction.value(x[2]);
  continuum.dilation_angle = 90 * dilation.value(x[3]) - 90;
  continuum.hardening_strain = hardening.value(x[4]);
  if (x.size() == 6)
    continuum.stiffness_exponent = exponent.value(x[5]);
  return continuum;
}

} // namespace

HardeningFit fit_hardening(const std::vector<SandTest> &tests, const fe::MohrCoulombParameters &start)
{
  const auto curves_at = [&](const Vector &x) { return curves_of(fe::MohrCoulomb(continuum_of(x, start)), tests); };
  Vector best;
  double least = HUGE_VAL;
  for (const double strain : {1e-4, 1e-3, 1e-2})
  {
    Vector x(start.reference_pressure > 0 ? 6 : 5);
    x.head(5) << modulus.number(1), ratio.number(std::max(start.poisson_ratio, ratio.least)),
        friction.number(start.friction_angle), dilation.number(1 + start.dilation_angle / 90), hardening.number(strain);
    if (x.size() == 6)
      x[5] = exponent.number(std::max(start.stiffness_exponent, exponent.least));
    x = least_misfit(tests, curves_at, x);
    if (const double size = misfit_at(tests, curves_at, x); size < least)
    {
      least = size;
      best = x;
    }
  }
  return {continuum_of(best, start), misfit(tests, curves_at(best))};
}

} // namespace bergamo::driver
