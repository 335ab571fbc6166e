#pragma once

#include "coupling/arlequin/overlap.h"

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

namespace bergamo::coupling
{

// Weight w of the grains in the virtual work, 1 - w that of the continuum (Wellmann, 6.1-6.4): 1 on the side of the
// grains alone, 0 on the side of the continuum alone, interpolated from nodal values between [6.27].

/// Least share of either model. A weighted mass must stay positive, and small masses ask for small steps: contacts of a
/// particle of weight w_min to neighbours of weight w_min + d stiffen it by the factor 1 + d / (2 w_min), with d about
/// the grain size over the width of the overlap. The error is a work counted 1 + w_min times at the far edge.
inline constexpr double default_min_weight = 0.01;

/// Weight of each coupled particle in [min_weight, 1] from the weights of the coupling nodes, w_alpha = sum N_I w_I.
/// Throws std::invalid_argument for nodal weights outside [0, 1], of wrong number, or min_weight outside (0, 1].
std::vector<double> particle_weights(const Overlap &overlap, std::span<const double> node_weight,
                                     double min_weight = default_min_weight);

/// Weight of the continuum where the grains have w, bounded in the same way.
inline double continuum_weight(const double w, const double min_weight = default_min_weight)
{
  return std::clamp(1. - w, min_weight, 1.);
}

/// Place of a contact along the line of centres, 0 at a and 1 at b (the fraction in [6.29]). Any unit, any frame.
template <class Vector>
auto centre_line_fraction(const Vector &centre_a, const Vector &centre_b, const Vector &contact)
{
  const Vector line = centre_b - centre_a;
  return line.dot(contact - centre_a) / line.dot(line);
}

/// Weight at a contact, linear between the weights of the two centres [6.29]. The fraction is held within [0, 1], so
/// that a contact beside the line of centres keeps a weight between those of its particles. Real: double or a pack.
template <class Real>
Real contact_weight(const Real &w_a, const Real &w_b, const Real &fraction)
{
  if constexpr (std::is_arithmetic_v<Real>)
    return fraction <= 0 ? w_a : fraction >= 1 ? w_b : w_a + fraction * (w_b - w_a);
  else
    return (fraction <= 0.).select(w_a, (fraction >= 1.).select(w_b, w_a + fraction * (w_b - w_a)));
}

} // namespace bergamo::coupling
