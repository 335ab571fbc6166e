#pragma once

#include "dem/geometry/moments.h"

#include <algorithm>
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

  /// Beside a kink both rules may agree by chance: then the change by halving says more. A kink stays in one half,
  /// where its error is about a quarter.
  void raise_error(const double least)
  {
    sum.error += std::max(0., least - of_rule);
    of_rule = std::max(of_rule, least);
  }

  /// Gauss-Kronrod rule of 7 and 15 points; their difference is the error of the lower one. QUADPACK's smaller
  /// estimate, (200 difference)^1.5, holds for smooth functions and is too small beside kinks.
  template <class Function>
  void integrate(const Function &f)
  {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
    using Gauss = boost::math::quadrature::gauss<double, 7>;
    const auto &nodes = Kronrod::abscissa();
    const auto &weights = Kronrod::weights();
    const double half = 0.5 * (to - from), middle = 0.5 * (to + from);
    Moments kronrod = Moments::Zero(), gauss = Moments::Zero();
    double inner_error = 0.;
    for (int k = 0; k < 15; ++k)
    {
      const int i = std::abs(k - 7);
      const double t = middle + (k < 7 ? -half : half) * nodes[i];
      const Integral inner = f(a + (b - a) * t * t * (3. - 2. * t));
      const double slope = (b - a) * 6. * t * (1. - t);
      kronrod += half * weights[i] * slope * inner.value;
      inner_error += half * weights[i] * slope * inner.error;
      if (i % 2 == 0)
        gauss += half * Gauss::weights()[i / 2] * slope * inner.value;
    }
    const double rule_error = (kronrod - gauss).abs().maxCoeff();
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
  const auto halve = [&](const detail::QuadraturePiece &piece)
  {
    const double middle = 0.5 * (piece.from + piece.to);
    detail::QuadraturePiece halves[2] = {{piece.a, piece.b, piece.from, middle, {}, 0.},
                                         {piece.a, piece.b, middle, piece.to, {}, 0.}};
    for (detail::QuadraturePiece &half : halves)
      half.integrate(f);
    const double change = (halves[0].sum.value + halves[1].sum.value - piece.sum.value).abs().maxCoeff();
    for (detail::QuadraturePiece &half : halves)
    {
      half.raise_error(0.25 * change);
      error += half.of_rule;
      pieces.push_back(half);
      std::push_heap(pieces.begin(), pieces.end());
    }
  };
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
  {
    detail::QuadraturePiece segment{breaks[k], breaks[k + 1], 0., 1., {}, 0.};
    segment.integrate(f);
    halve(segment);
  }
  while (error > tolerance && static_cast<int>(pieces.size()) < max_pieces)
  {
    std::pop_heap(pieces.begin(), pieces.end());
    const detail::QuadraturePiece worst = pieces.back();
    pieces.pop_back();
    error -= worst.of_rule;
    halve(worst);
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
