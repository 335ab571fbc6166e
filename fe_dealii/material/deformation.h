#pragma once

namespace bergamo::fe
{

/// 3×3 tensor, [row][column]. A deformation gradient F has rows in the present, columns in the reference frame.
template <class Real>
struct Tensor3
{
  Real at[3][3];

  Real *operator[](const int row) { return at[row]; }
  const Real *operator[](const int row) const { return at[row]; }
};

/// Cofactor: det F times the inverse transposed of F, and the derivative of det F by F.
template <class Real>
Tensor3<Real> cofactor(const Tensor3<Real> &f)
{
  Tensor3<Real> result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      result[i][j] = f[i1][j1] * f[i2][j2] - f[i1][j2] * f[i2][j1];
    }
  return result;
}

/// det F, where its cofactor is known anyway.
template <class Real>
Real determinant(const Tensor3<Real> &f, const Tensor3<Real> &cofactor)
{
  return f[0][0] * cofactor[0][0] + f[0][1] * cofactor[0][1] + f[0][2] * cofactor[0][2];
}

/// Right Cauchy-Green tensor C = F^T F, xx yy zz xy yz zx.
template <class Real>
void right_cauchy_green(const Tensor3<Real> &f, Real (&c)[6])
{
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int k = 0; k < 6; ++k)
    c[k] = f[0][row[k]] * f[0][column[k]] + f[1][row[k]] * f[1][column[k]] + f[2][row[k]] * f[2][column[k]];
}

/// F S for a symmetric S, xx yy zz xy yz zx: a first Piola-Kirchhoff stress from the second.
template <class Real>
Tensor3<Real> times_symmetric(const Tensor3<Real> &f, const Real (&s)[6])
{
  Tensor3<Real> result;
  for (int i = 0; i < 3; ++i)
  {
    result[i][0] = f[i][0] * s[0] + f[i][1] * s[3] + f[i][2] * s[5];
    result[i][1] = f[i][0] * s[3] + f[i][1] * s[1] + f[i][2] * s[4];
    result[i][2] = f[i][0] * s[5] + f[i][1] * s[4] + f[i][2] * s[2];
  }
  return result;
}

} // namespace bergamo::fe
