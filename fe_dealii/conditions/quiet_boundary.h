#pragma once

#include "fe_dealii/boundary/dashpots.h"

#include <vector>

namespace bergamo::fe
{

class ExplicitBody;

/// Dashpots that let waves leave a body through a boundary: the traction −ρ c_p v along the normal and −ρ c_s v across
/// it (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859-877), integrated over the faces and lumped at their
/// nodes, ∫ N dA each. Density and moduli are those of each face's element; where its law depends on the pressure, of
/// its stiffest point in the present stresses. A wave along the normal leaves without reflection, others the less
/// straight they come (docs/results/continuum.md). Areas and normals are those of the reference configuration, the
/// moduli those of small strain, and a continuum's share is not in it. What presses on such a boundary for long moves
/// it, at the speed p/(ρ c_p). For MovingBody::add_dashpots().
/// Throws ConfigError for a boundary that the mesh lacks and a face so distorted that a node has no part of it.
std::vector<Dashpot> quiet_boundary(const ExplicitBody &body, unsigned int boundary_id);

} // namespace bergamo::fe
