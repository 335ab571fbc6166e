#pragma once

#include "coupling/adapter/body_mover.h"
#include "coupling/arlequin/overlap.h"
#include "dem/state/particles.h"

#include <span>
#include <vector>

/// What an overlap of grains and a body is made of.
namespace bergamo::coupling
{

/// The overlap of a body and of all grains, element by element and in the order of their ids: it is the same after a
/// restart.
/// @param reference_by_id places in the body's reference configuration [m]
/// @param nodal_weight, reach see make_overlap()
/// @throws ConfigError as make_overlap()
Overlap overlap_of(const dem::Particles &particles, const SolidMover &body, std::span<const Vec3> reference_by_id,
                   std::span<const double> nodal_weight, double reach);

/// Weights of the coupling nodes and of the coupled particles.
struct OverlapWeights
{
  std::vector<double> node, particle;

  /// @param nodal_weight of all nodes of the body; @throws ConfigError as particle_weights()
  OverlapWeights(const Overlap &overlap, std::span<const double> nodal_weight, double least_weight);
};

/// Displacement of a body at the coupled particles [m].
std::vector<Vec3> displacement_at(const Overlap &overlap, const fe::ExplicitBody &body);

} // namespace bergamo::coupling
