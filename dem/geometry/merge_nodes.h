#pragma once

#include "dem/core/types.h"
#include "dem/geometry/surface_topology.h"

#include <vector>

namespace bergamo::dem
{

/// Makes one node of those that lie in the same place, so that neighbours share nodes, and removes those of no
/// triangle. In their order, a node goes to the first one kept that is not farther than the tolerance; so the result
/// does not depend on the surface's place or turn, and no chain of nodes collapses. Triangles that are smaller name a
/// node twice afterwards.
/// @param[in,out] node places [m], finite; @param[in,out] triangles of nodes that are there; @param tolerance > 0 [m]
void merge_nodes(std::vector<Vec3> &node, std::vector<Triangle> &triangles, double tolerance);

} // namespace bergamo::dem
