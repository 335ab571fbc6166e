#pragma once

#include "dem/core/pack.h"
#include "fe_dealii/material/tensor.h"

namespace bergamo::fe
{

/// value[0] >= value[1] >= value[2]; direction[k] is the unit eigenvector of value[k]. The three are orthonormal.
template <class Real>
struct PrincipalFrame
{
  Real value[3];
  Real direction[3][3];
};

/// Eigen-decomposition of `stress` (xx yy zz xy yz zx) by cyclic Jacobi rotations (Golub & Van Loan 2013, sec. 8.5),
/// without branches, so that a pack of stresses costs little more than one. The closed trigonometric form is faster but
/// loses half the digits where two eigenvalues nearly agree, which is where the yield surface has its edges. A NaN in
/// gives NaN out. At most eight sweeps; four suffice in practice.
template <class Real>
PrincipalFrame<Real> principal_frame(const Real (&stress)[6])
{
  const Real zero = stress[0] * 0., one = zero + 1.;
  Real d[3] = {stress[0], stress[1], stress[2]};
  Real off[3] = {stress[3], stress[4], stress[5]}; // off[i] couples i and i + 1
  Real v[3][3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (int sweep = 0; sweep < 8; ++sweep)
  {
    const Real off_square = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
    if (!math::any(off_square > 1e-34 * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2])))
      break;
#pragma GCC unroll 3
    for (int p = 0; p < 3; ++p)
    {
      const int q = (p + 1) % 3, r = (p + 2) % 3;
      const Real coupling = off[p];
      const Real half_gap = 0.5 * (d[q] - d[p]);
      const Real root = math::sqrt(Real(half_gap * half_gap + coupling * coupling));
      const Real denominator = math::select(half_gap >= 0., Real(half_gap + root), Real(half_gap - root));
      const Real t = coupling / math::select(denominator == 0., one, denominator);
      const Real c = 1. / math::sqrt(Real(1. + t * t)), s = t * c;
      d[p] -= t * coupling;
      d[q] += t * coupling;
      off[p] = zero;
      const Real qr = off[q], rp = off[r];
      off[r] = c * rp - s * qr;
      off[q] = s * rp + c * qr;
      for (int i = 0; i < 3; ++i)
      {
        const Real vp = v[p][i], vq = v[q][i];
        v[p][i] = c * vp - s * vq;
        v[q][i] = s * vp + c * vq;
      }
    }
  }
#pragma GCC unroll 3
  for (int step = 0; step < 3; ++step) // sorting network for three
  {
    const int p = step % 2, q = p + 1;
    const auto wrong = d[p] < d[q];
    const auto exchange = [&](Real &x, Real &y)
    {
      const Real old = x;
      x = math::select(wrong, y, x);
      y = math::select(wrong, old, y);
    };
    exchange(d[p], d[q]);
    for (int i = 0; i < 3; ++i)
      exchange(v[p][i], v[q][i]);
  }
  PrincipalFrame<Real> frame;
  for (int k = 0; k < 3; ++k)
  {
    frame.value[k] = d[k];
    for (int i = 0; i < 3; ++i)
      frame.direction[k][i] = v[k][i];
  }
  return frame;
}

inline PrincipalFrame<double> principal_frame(const Stress &stress)
{
  return principal_frame<double>({stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]});
}

/// Σ value[k] direction[k] ⊗ direction[k].
inline Stress from_principal(const double (&value)[3], const double (&direction)[3][3])
{
  Stress stress{};
  for (int k = 0; k < 3; ++k)
  {
    const double x = direction[k][0], y = direction[k][1], z = direction[k][2];
    stress[0] += value[k] * x * x;
    stress[1] += value[k] * y * y;
    stress[2] += value[k] * z * z;
    stress[3] += value[k] * x * y;
    stress[4] += value[k] * y * z;
    stress[5] += value[k] * z * x;
  }
  return stress;
}

} // namespace bergamo::fe
