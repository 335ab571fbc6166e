#pragma once

#include "dem/shape/moments.h"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <utility>
#include <vector>

namespace bergamo::dem
{

/// Several integrals of one function, with an estimate of the largest error among them.
struct Integral
{
  Moments value = Moments::Zero();
  double error = 0.;
};

namespace detail
{

/// A piece of a segment [a, b] on which the integrand is smooth inside; its ends may be roots. x = a + (b - a) s(t)
/// with s = t^2 (3 - 2t) leaves no root there, and t runs over [from, to] in [0, 1].
struct QuadraturePiece
{
  double a, b, from, to;
  Integral sum;

  double of_rule = 0.; ///< the part of the error that halving makes smaller

  bool operator<(const QuadraturePiece &o) const { return of_rule < o.of_rule; } // the heap's top is the largest

  /// Gauss-Kronrod rule of 7 and 15 points with QUADPACK's estimate of its error (Piessens et al. 1983, 2.2.1).
  template <class Function>
  void integrate(const Function &f)
  {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
    using Gauss = boost::math::quadrature::gauss<double, 7>;
    const auto &nodes = Kronrod::abscissa();
    const auto &weights = Kronrod::weights();
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    std::array<Moments, 15> values;
    std::array<double, 15> weight;
    Moments kronrod = Moments::Zero(), gauss = Moments::Zero();
    double inner_error = 0.;
    for (int k = 0; k < 15; ++k)
    {
      const int i = std::abs(k - 7);
      const double t = middle + (k < 7 ? -half : half) * nodes[i];
      const Integral inner = f(a + (b - a) * t * t * (3. - 2. * t));
      const double slope = (b - a) * 6. * t * (1. - t);
      weight[k] = half * weights[i];
      values[k] = inner.value * slope;
      kronrod += weight[k] * values[k];
      inner_error += weight[k] * slope * inner.error;
      if (i % 2 == 0)
        gauss += half * Gauss::weights()[i / 2] * values[k];
    }
    Moments spread = Moments::Zero();
    for (int k = 0; k < 15; ++k)
      spread += weight[k] * (values[k] - kronrod / (to - from)).abs();
    double rule_error = 0.;
    for (int d = 0; d < kronrod.size(); ++d)
    {
      const double difference = std::abs(kronrod[d] - gauss[d]);
      rule_error = std::max(rule_error, difference == 0. || spread[d] == 0.
                                            ? difference
                                            : spread[d] * std::min(1., std::pow(200. * difference / spread[d], 1.5)));
    }
    sum = {kronrod, rule_error + inner_error};
    of_rule = rule_error;
  }
};

} // namespace detail

/// Integrates f from the first to the last of the ascending breaks, between which it is smooth but for kinks: the piece
/// with the largest error is halved until all errors add up to the tolerance or there are max_pieces. Kinks cost some
/// ten halvings each. @param f double -> Integral
template <class Function>
Integral integrate(const Function &f, const std::vector<double> &breaks, const double tolerance, const int max_pieces)
{
  std::vector<detail::QuadraturePiece> pieces;
  double error = 0.;
  const auto add = [&](detail::QuadraturePiece piece)
  {
    piece.integrate(f);
    error += piece.of_rule;
    pieces.push_back(piece);
    std::push_heap(pieces.begin(), pieces.end());
  };
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    add({breaks[k], breaks[k + 1], 0., 1., {}, 0.});
  while (error > tolerance && static_cast<int>(pieces.size()) < max_pieces)
  {
    std::pop_heap(pieces.begin(), pieces.end());
    const detail::QuadraturePiece worst = pieces.back();
    pieces.pop_back();
    error -= worst.of_rule;
    const double middle = 0.5 * (worst.from + worst.to);
    add({worst.a, worst.b, worst.from, middle, {}, 0.});
    add({worst.a, worst.b, middle, worst.to, {}, 0.});
  }
  Integral sum;
  for (const detail::QuadraturePiece &piece : pieces)
  {
    sum.value += piece.sum.value;
    sum.error += piece.sum.error;
  }
  return sum;
}

} // namespace bergamo::dem
