#pragma once

#include "dem/core/pack.h"

namespace bergamo::fe
{

/// A symmetric tensor by its principal values and what they stand on, without eigenvectors: the value that lies apart
/// from the other two has the dyad n ⊗ n, the other two share the plane across n, where the difference of their dyads
/// says the rest. Where the two agree their directions are undetermined, but what is rebuilt is not: the difference is
/// then multiplied by the difference of two numbers that agree as well.
template <class Real>
struct PrincipalDyads
{
  Real value[3];                ///< falling, to rounding
  math::Mask<Real> first_apart; ///< value[0] lies apart from the others, else value[2]
  Real apart[6];                ///< n ⊗ n of that value, xx yy zz xy yz zx
  Real difference[6];           ///< dyad of the greater of the others less that of the smaller; 0 where they agree
};

/// 2 cos(arccos(x)/3) for x in [0, 1], to 4e-9: interpolated at the nine zeros of Chebyshev's polynomial.
template <class Real>
Real twice_cosine_of_third(const Real &x)
{
  constexpr double coefficient[] = {1.732050811199125,     0.33333274228932186,   -0.09620888291054976,
                                    0.04920859361469354,   -0.030214550426206997, 0.018766661347778303,
                                    -0.009859382580644806, 0.003529713889697126,  -0.0006057084388481194};
  Real sum(coefficient[8]);
#pragma GCC unroll 8
  for (int k = 7; k >= 0; --k)
    sum = sum * x + coefficient[k];
  return sum;
}

/// The value apart is a simple zero of the characteristic polynomial and keeps all digits whatever the other two do
/// (Scherzinger & Dohrmann, Comput. Methods Appl. Mech. Engrg. 197 (2008) 4007-4015), where the trigonometric form of
/// all three loses half of them; here it takes a polynomial and one step of Newton's. Its dyad is the adjugate of what
/// remains. No branches, so a pack costs hardly more than one tensor. A NaN in gives NaN out.
/// @param tensor xx yy zz xy yz zx; errors are some rounding of its norm
template <class Real>
PrincipalDyads<Real> principal_dyads(const Real (&tensor)[6])
{
  constexpr double vanishing = 1e-290, negligible = 1e-60; // so that no root is of zero
  const Real mean = (tensor[0] + tensor[1] + tensor[2]) * (1. / 3.);
  Real a[6] = {tensor[0] - mean, tensor[1] - mean, tensor[2] - mean, tensor[3], tensor[4], tensor[5]};
  // Scaled to J2 = 3, the values are the zeros of x³ - 3x - det.
  const Real third =
      ((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * 0.5 + a[3] * a[3] + a[4] * a[4] + a[5] * a[5]) * (1. / 3.);
  const Real inverse = math::inverse_sqrt(math::select(third <= vanishing, Real(1.), third));
  const Real scale = third * inverse;
  for (Real &component : a)
    component *= inverse;
  const Real determinant =
      a[0] * (a[1] * a[2] - a[4] * a[4]) + a[3] * (a[4] * a[5] - a[3] * a[2]) + a[5] * (a[3] * a[4] - a[1] * a[5]);

  PrincipalDyads<Real> result;
  result.first_apart = determinant >= 0.;
  const Real twice = math::select(result.first_apart, determinant, Real(-determinant));
  const Real bounded = math::select(twice > 2., Real(2.), twice);
  const Real guess = twice_cosine_of_third(Real(0.5 * bounded)); // in [√3, 2]
  const Real square = guess * guess;
  Real inverse_slope = 1. / (3. * square - 3.);
  const Real size = guess - (guess * (square - 3.) - bounded) * inverse_slope;
  inverse_slope = inverse_slope * (2. - (3. * size * size - 3.) * inverse_slope);
  const Real apart = math::select(result.first_apart, size, Real(-size));

  const Real x = a[0] - apart, y = a[1] - apart, z = a[2] - apart;
  result.apart[0] = (y * z - a[4] * a[4]) * inverse_slope;
  result.apart[1] = (x * z - a[5] * a[5]) * inverse_slope;
  result.apart[2] = (x * y - a[3] * a[3]) * inverse_slope;
  result.apart[3] = (a[4] * a[5] - a[3] * z) * inverse_slope;
  result.apart[4] = (a[3] * a[5] - a[4] * x) * inverse_slope;
  result.apart[5] = (a[3] * a[4] - a[5] * y) * inverse_slope;

  const Real middle = -0.5 * apart; // of the other two
  for (int i = 0; i < 6; ++i)
  {
    a[i] -= 1.5 * apart * result.apart[i];
    if (i < 3)
      a[i] -= middle;
  }
  const Real half_square = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * 0.5 + a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
  const Real inverse_half = math::inverse_sqrt(math::select(half_square <= negligible, Real(1.), half_square));
  for (int i = 0; i < 6; ++i)
    result.difference[i] = a[i] * inverse_half;
  const Real alone = mean + scale * apart, half = scale * half_square * inverse_half, between = mean + scale * middle;
  const Real greater = between + half, smaller = between - half;
  result.value[0] = math::select(result.first_apart, alone, greater);
  result.value[1] = math::select(result.first_apart, greater, smaller);
  result.value[2] = math::select(result.first_apart, smaller, alone);
  return result;
}

/// The tensor of these principal values, in the frame of the dyads. Where two of the dyads' own values agree within
/// rounding, so must these.
template <class Real>
void from_dyads(const Real (&value)[3], const PrincipalDyads<Real> &dyads, Real (&tensor)[6])
{
  const Real alone = math::select(dyads.first_apart, value[0], value[2]);
  const Real greater = math::select(dyads.first_apart, value[1], value[0]);
  const Real smaller = math::select(dyads.first_apart, value[2], value[1]);
  const Real middle = 0.5 * (greater + smaller), half = 0.5 * (greater - smaller), beyond = alone - middle;
  for (int i = 0; i < 6; ++i)
  {
    tensor[i] = beyond * dyads.apart[i] + half * dyads.difference[i];
    if (i < 3)
      tensor[i] += middle;
  }
}

} // namespace bergamo::fe
