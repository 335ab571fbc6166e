#pragma once

#include "coupling/arlequin/overlap.h"

#include <span>
#include <vector>

namespace bergamo::coupling
{

// Weight w of the grains in the virtual work, 1 - w that of the continuum (Wellmann, 6.1-6.4): 1 on the side of the
// grains alone, 0 on the side of the continuum alone, interpolated from nodal values between [6.27].

/// Least share of either model. A weighted mass must stay positive, and small masses ask for small steps: contacts of a
/// particle of weight w_min to neighbours of weight w_min + d stiffen it by the factor 1 + d / (2 w_min), with d about
/// the grain size over the width of the overlap. The error is a work counted 1 + w_min times at the far edge.
inline constexpr double default_min_weight = 0.05;

/// How weights grow from the continuum's side of an overlap to that of the grains.
enum class WeightShape
{
  linear,
  smooth ///< 3 s^2 - 2 s^3, with no slope at both ends; in one layer of elements the same as linear
};

/// @param share of the way through the overlap from the continuum's side; beyond [0, 1] the weight stays 0 or 1
double weight_at(WeightShape shape, double share);

/// Weight of each coupled particle in [min_weight, 1] from the weights of the coupling nodes, w_alpha = sum N_I w_I.
/// Throws ConfigError for nodal weights outside [0, 1], of wrong number, or min_weight outside (0, 1].
std::vector<double> particle_weights(const Overlap &overlap, std::span<const double> node_weight,
                                     double min_weight = default_min_weight);

} // namespace bergamo::coupling
