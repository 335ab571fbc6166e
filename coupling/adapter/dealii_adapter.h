#pragma once

#include "coupling/arlequin/overlap.h"
#include "dem/state/particles.h"
#include "fe_dealii/explicit_body.h"

#include <span>

namespace bergamo::coupling
{

/// Where grains and elements share the space: the coupled particles are those whose centre lies in an element of the
/// body's reference configuration, the coupled elements those that hold a centre (Wellmann 6.3). Shape values from
/// deal.II's inverse mapping, V_IJ by Gauss quadrature.
/// @param id, position [m], volume [m^3] of the grains in their reference configuration
/// @throws ConfigError (Overlap::validate) where a node is reached by no grain or nothing overlaps
Overlap make_overlap(const fe::ExplicitBody &body, std::span<const std::int64_t> id, std::span<const Vec3> position,
                     std::span<const double> volume);

} // namespace bergamo::coupling
