#pragma once

#include "fe_dealii/material/hypoplastic.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

/// Sands, and hypoplasticity written apart from the program: tensors of nine components, angles as in the paper.
namespace bergamo::fe::sands
{

/// Hochstetten sand, as Niemunis and Herle (Mech. Cohes.-Frict. Mater. 2 (1997) 279-299) use it.
inline HypoplasticParameters hochstetten()
{
  return {.critical_friction_angle = 33,
          .granulate_hardness = 1000e6,
          .compression_exponent = 0.25,
          .densest_void_ratio = 0.55,
          .critical_void_ratio = 0.95,
          .loosest_void_ratio = 1.05,
          .pyknotropy_exponent = 0.25,
          .stiffness_exponent = 1.5};
}

/// Another one, about Toyoura sand in Herle and Gudehus (1999), not checked against their table either: what is tested
/// holds for any.
inline HypoplasticParameters fine_sand()
{
  return {.critical_friction_angle = 30,
          .granulate_hardness = 2600e6,
          .compression_exponent = 0.27,
          .densest_void_ratio = 0.61,
          .critical_void_ratio = 0.98,
          .loosest_void_ratio = 1.10,
          .pyknotropy_exponent = 0.18,
          .stiffness_exponent = 1.10};
}

inline constexpr double epsilon = 2.2e-16;

using Tensor = std::array<std::array<double, 3>, 3>;

inline Tensor tensor(const std::array<double, 6> &t, const double shear = 1)
{
  const double xy = shear * t[3], yz = shear * t[4], zx = shear * t[5];
  return {{{t[0], xy, zx}, {xy, t[1], yz}, {zx, yz, t[2]}}};
}
inline Tensor strain_tensor(const Strain &strain)
{
  return tensor(strain, 0.5);
}
inline Stress components(const Tensor &t)
{
  return {t[0][0], t[1][1], t[2][2], t[0][1], t[1][2], t[2][0]};
}
inline Strain strain_components(const Tensor &t)
{
  return {t[0][0], t[1][1], t[2][2], 2 * t[0][1], 2 * t[1][2], 2 * t[2][0]};
}
inline Tensor times(const Tensor &a, const Tensor &b)
{
  Tensor result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        result[i][j] += a[i][k] * b[k][j];
  return result;
}
inline Tensor transposed(const Tensor &a)
{
  Tensor result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i][j] = a[j][i];
  return result;
}
inline double trace(const Tensor &a)
{
  return a[0][0] + a[1][1] + a[2][2];
}
inline double product(const Tensor &a, const Tensor &b)
{
  return trace(times(a, transposed(b)));
}

/// a, T̂, T̂* and F of a stress.
struct Directions
{
  double a, f;
  Tensor ratio, deviator;
};
inline Directions directions(const HypoplasticParameters &p, const Tensor &stress)
{
  Directions d;
  const double sine = std::sin(p.critical_friction_angle * std::numbers::pi / 180);
  d.a = std::sqrt(3.) * (3 - sine) / (2 * std::sqrt(2.) * sine);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
    {
      d.ratio[i][j] = stress[i][j] / trace(stress);
      d.deviator[i][j] = d.ratio[i][j] - (i == j ? 1. / 3 : 0);
    }
  const double size = std::sqrt(product(d.deviator, d.deviator)), tan_psi = std::sqrt(3.) * size;
  const double cos_3_theta =
      -std::sqrt(6.) * trace(times(d.deviator, times(d.deviator, d.deviator))) / (size * size * size);
  d.f = size < 1e-9
            ? 1
            : std::sqrt(tan_psi * tan_psi / 8 + (2 - tan_psi * tan_psi) / (2 + std::sqrt(2.) * tan_psi * cos_3_theta)) -
                  tan_psi / (2 * std::sqrt(2.));
  return d;
}

/// T̊ for a state inside the limits of the equation.
inline Tensor reference_rate(const HypoplasticParameters &p, const Tensor &stress, const double e, const Tensor &d)
{
  const Directions at = directions(p, stress);
  const double x = -trace(stress) / p.granulate_hardness, n = p.compression_exponent, a = at.a;
  const double share = std::exp(-std::pow(x, n));
  const double ed = p.densest_void_ratio * share, ec = p.critical_void_ratio * share, ei = p.loosest_void_ratio * share;
  const double f_d = std::pow((e - ed) / (ec - ed), p.pyknotropy_exponent);
  const double f_e = std::pow(ec / e, p.stiffness_exponent);
  const double f_b =
      p.granulate_hardness / n * std::pow(p.loosest_void_ratio / p.critical_void_ratio, p.stiffness_exponent) *
      (1 + ei) / ei * std::pow(x, 1 - n) /
      (3 + a * a -
       a * std::sqrt(3.) *
           std::pow((p.loosest_void_ratio - p.densest_void_ratio) / (p.critical_void_ratio - p.densest_void_ratio),
                    p.pyknotropy_exponent));
  const double f_s = f_b * f_e / product(at.ratio, at.ratio);
  const double along = product(at.ratio, d), size = std::sqrt(product(d, d));
  Tensor rate;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      rate[i][j] = f_s * (at.f * at.f * d[i][j] + a * a * along * at.ratio[i][j] +
                          f_d * a * at.f * (at.ratio[i][j] + at.deviator[i][j]) * size);
  return rate;
}

/// States and strains drawn at random.
class Random
{
public:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
  double normal() { return std::normal_distribution<double>()(engine_); }

  Tensor symmetric()
  {
    Tensor t;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        t[i][j] = t[j][i] = normal();
    return t;
  }
  /// Of a unit quaternion.
  Tensor rotation()
  {
    double q[4], square = 0;
    for (double &x : q)
    {
      x = normal();
      square += x * x;
    }
    const double s = 2 / square, a = q[0], b = q[1], c = q[2], d = q[3];
    return {{{1 - s * (c * c + d * d), s * (b * c - a * d), s * (b * d + a * c)},
             {s * (b * c + a * d), 1 - s * (b * b + d * d), s * (c * d - a * b)},
             {s * (b * d - a * c), s * (c * d + a * b), 1 - s * (b * b + c * c)}}};
  }
  static Tensor turned(const Tensor &rotation, const Tensor &t)
  {
    return times(rotation, times(t, transposed(rotation)));
  }
  /// Compressive, 1 kPa to 1 MPa, principal stresses up to four times each other, between the limits of void ratio.
  SandState state(const HypoplasticSand &sand)
  {
    const double size = std::pow(10., 3 + 3 * unit());
    Tensor stress{};
    for (int i = 0; i < 3; ++i)
      stress[i][i] = -size * (0.25 + 0.75 * unit());
    const double pressure = -trace(stress) / 3;
    const LimitVoidRatios limits = sand.limit_void_ratios(pressure);
    const double e = limits.densest + (limits.loosest - limits.densest) * (0.01 + 0.98 * unit());
    return {components(turned(rotation(), stress)), e};
  }

private:
  std::mt19937_64 engine_{7};
};

inline Stress difference(const Stress &a, const Stress &b)
{
  Stress result;
  for (int i = 0; i < 6; ++i)
    result[i] = a[i] - b[i];
  return result;
}

} // namespace bergamo::fe::sands
