#pragma once

#include "coupling/arlequin/overlap.h"
#include "dem/state/particles.h"
#include "fe_dealii/explicit_body.h"

#include <span>
#include <vector>

namespace bergamo::coupling
{

/// Where grains and elements share the space: the coupled particles are those whose centre lies in an element of the
/// body's reference configuration, the coupled elements those that hold a centre (Wellmann 6.3). Shape values from
/// deal.II's inverse mapping. Particles stand element by element, in one in the order given. A particle above the mesh,
/// where an overlap comes to a free surface, belongs to the nearest place of the mesh within `reach`: else it would
/// weigh 1 beside neighbours that weigh little, and its contacts, which would count wholly, ask for small steps.
/// @param id, position [m], volume [m^3] of the grains in their reference configuration
/// @param nodal_weight of the grains, one a node: elements where all are 1 are left to grains alone
/// @throws ConfigError (Overlap::validate) where nothing overlaps
Overlap make_overlap(const fe::ExplicitBody &body, std::span<const std::int64_t> id, std::span<const Vec3> position,
                     std::span<const double> volume, std::span<const double> nodal_weight, double reach);

/// Where places of the present configuration lie in the body's reference configuration, X + u(X) = x, up to the square
/// of its displacement's gradient times the displacement; u is that of the nearest place of the mesh beside it, within
/// `reach`, and zero further away [m].
std::vector<Vec3> reference_places(const fe::ExplicitBody &body, std::span<const Vec3> position, double reach);

/// A nodal field (3 * node + component) at places of the body's reference configuration; zero in no element.
std::vector<Vec3> values_at(const fe::ExplicitBody &body, std::span<const Vec3> position,
                            std::span<const double> field);

/// A lower bound of the distance from places to a body's elements in the present configuration, 0 within and beside
/// them: that to the nearest box about one in the reference configuration, less the greatest displacement [m].
std::vector<double> distances_to(const fe::ExplicitBody &body, std::span<const Vec3> position);

} // namespace bergamo::coupling
