#pragma once

#include <array>
#include <string>
#include <vector>

namespace bergamo::fe
{

class MovingBody;

/// A piece of a body that nothing joins to the others, and the rigid motions that no prescribed dof prevents.
struct UnheldPiece
{
  std::array<double, 3> centre{};   ///< mean of its nodes in the reference configuration [m]
  std::vector<std::string> motions; ///< "along x", "about the axis along y through (0, 1, 0) m"
};

/// Pieces that may move rigidly as their prescribed dofs are, whatever the stiffness; none in a body that is held.
std::vector<UnheldPiece> find_unheld(const MovingBody &body);

/// Throws ConfigError, with the pieces and their motions, where find_unheld() finds any.
void require_held(const MovingBody &body);

} // namespace bergamo::fe
