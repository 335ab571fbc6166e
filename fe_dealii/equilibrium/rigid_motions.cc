#include "fe_dealii/equilibrium/rigid_motions.h"

#include "dem/core/error.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

namespace bergamo::fe
{
namespace
{

using Vector = std::array<double, 3>;
using Motion = std::array<double, 6>; // rotation about the piece's centre times its size, translation
using Gram = std::array<Motion, 6>;

constexpr double negligible = 1e-9; // of squares, against the largest

/// Nodes that share elements, or are images of one another, in pieces.
std::vector<std::vector<unsigned int>> pieces_of(const MovingBody &body)
{
  std::vector<unsigned int> parent(body.n_nodes());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root = [&](unsigned int node)
  {
    while (parent[node] != node)
      node = parent[node] = parent[parent[node]];
    return node;
  };
  const auto join = [&](const unsigned int a, const unsigned int b)
  { parent[std::max(root(a), root(b))] = std::min(root(a), root(b)); };
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (const unsigned int node : body.element_nodes(e))
      join(node, body.element_nodes(e)[0]);
  for (const NodeImages::Group &group : body.images().groups())
    for (const unsigned int node : group.nodes)
      join(node, group.nodes[0]);
  std::vector<std::vector<unsigned int>> of_root(body.n_nodes()), pieces;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
    of_root[root(node)].push_back(node);
  for (auto &nodes : of_root)
    if (!nodes.empty())
      pieces.push_back(std::move(nodes));
  return pieces;
}

Vector cross(const Vector &a, const Vector &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double norm(const Vector &a)
{
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// Σ r rᵀ over the held dofs, r what the six rigid motions move them by, and over what images have to move alike by.
Gram held_motions(const MovingBody &body, const std::vector<unsigned int> &nodes, const Vector &centre,
                  const double size)
{
  Gram gram{};
  const auto row_of = [&](const unsigned int node, const std::size_t i)
  {
    Motion row{};
    row[3 + i] = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector turn{}, arm{};
      turn[axis] = 1;
      for (std::size_t k = 0; k < 3; ++k)
        arm[k] = (body.node_position()[node][k] - centre[k]) / size;
      row[axis] = cross(turn, arm)[i];
    }
    return row;
  };
  const auto add = [&](const Motion &row)
  {
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        gram[a][b] += row[a] * row[b];
  };
  for (const unsigned int node : nodes)
    for (std::size_t i = 0; i < 3; ++i)
    {
      if (body.constraint_of(3 * std::size_t(node) + i))
        add(row_of(node, i));
      Motion apart = row_of(node, i);
      const Motion first = row_of(body.images().first_of(node), i);
      for (int k = 0; k < 6; ++k)
        apart[k] -= first[k];
      add(apart);
    }
  return gram;
}

/// A basis of the motions that a Gram matrix gives nothing, by Gauss and Jordan. Rotations come first in the columns,
/// so a translation that is free by itself appears by itself.
std::vector<Motion> null_space(Gram gram)
{
  double largest = 0;
  for (int k = 0; k < 6; ++k)
    largest = std::max(largest, gram[k][k]);
  std::vector<int> pivots;
  std::size_t rank = 0;
  for (int column = 0; column < 6 && rank < 6; ++column)
  {
    std::size_t best = rank;
    for (std::size_t row = rank; row < 6; ++row)
      if (std::abs(gram[row][column]) > std::abs(gram[best][column]))
        best = row;
    if (!(std::abs(gram[best][column]) > negligible * largest))
      continue;
    std::swap(gram[rank], gram[best]);
    for (std::size_t row = 0; row < 6; ++row)
    {
      const double factor = row == rank ? 0 : gram[row][column] / gram[rank][column];
      for (int k = 0; k < 6; ++k)
        gram[row][k] -= factor * gram[rank][k];
    }
    pivots.push_back(column);
    ++rank;
  }
  std::vector<Motion> basis;
  for (int column = 0; column < 6; ++column)
  {
    if (std::find(pivots.begin(), pivots.end(), column) != pivots.end())
      continue;
    Motion motion{};
    motion[column] = 1;
    for (std::size_t row = 0; row < pivots.size(); ++row)
      motion[pivots[row]] = -gram[row][column] / gram[row][pivots[row]];
    basis.push_back(motion);
  }
  return basis;
}

/// "(1, 2, 3)" without what is rounding of the size.
std::string text_of(const Vector &vector, const double size)
{
  std::ostringstream text;
  for (int i = 0; i < 3; ++i)
    text << (i == 0 ? "(" : ", ") << (std::abs(vector[i]) < 1e-6 * size ? 0 : vector[i]);
  text << ")";
  return text.str();
}

std::string direction_text(Vector direction)
{
  const double length = norm(direction);
  for (int i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > (1 - 1e-6) * length)
      return std::string("along ") + "xyz"[i];
  for (double &component : direction)
    component /= length;
  return "along " + text_of(direction, 1);
}

std::string name_of(const Motion &motion, const Vector &centre, const double size)
{
  const Vector turn{motion[0] / size, motion[1] / size, motion[2] / size}, shift{motion[3], motion[4], motion[5]};
  const double angle = norm(turn);
  if (angle * size < 1e-6 * norm(shift))
    return direction_text(shift);
  Vector place = cross(turn, shift); // of the axis, from the centre
  for (int i = 0; i < 3; ++i)
    place[i] = centre[i] + place[i] / (angle * angle);
  return "about the axis " + direction_text(turn) + " through " + text_of(place, norm(centre) + size) + " m";
}

} // namespace

std::vector<UnheldPiece> find_unheld(const MovingBody &body)
{
  std::vector<UnheldPiece> unheld;
  for (const std::vector<unsigned int> &nodes : pieces_of(body))
  {
    UnheldPiece piece;
    for (const unsigned int node : nodes)
      for (int i = 0; i < 3; ++i)
        piece.centre[i] += body.node_position()[node][i] / nodes.size();
    double size = 0;
    for (const unsigned int node : nodes)
    {
      const Vector &place = body.node_position()[node];
      size = std::max(size, norm({place[0] - piece.centre[0], place[1] - piece.centre[1], place[2] - piece.centre[2]}));
    }
    std::vector<Motion> motions = null_space(held_motions(body, nodes, piece.centre, size));
    const auto turns = [](const Motion &m) { return norm({m[0], m[1], m[2]}) > 1e-6; };
    std::stable_sort(motions.begin(), motions.end(),
                     [&](const Motion &a, const Motion &b) { return turns(a) < turns(b); });
    for (const Motion &motion : motions)
      piece.motions.push_back(name_of(motion, piece.centre, size));
    if (!piece.motions.empty())
      unheld.push_back(std::move(piece));
  }
  return unheld;
}

void require_held(const MovingBody &body)
{
  const std::vector<UnheldPiece> unheld = find_unheld(body);
  if (unheld.empty())
    return;
  const bool is_whole = pieces_of(body).size() == 1;
  std::ostringstream message;
  message << "static equilibrium: ";
  for (const UnheldPiece &piece : unheld)
  {
    message << "nothing holds the ";
    if (is_whole)
      message << "body";
    else
      message << "piece at " << text_of(piece.centre, norm(piece.centre)) << " m";
    message << " against motions ";
    for (std::size_t k = 0; k < piece.motions.size(); ++k)
      message << (k > 0 ? ", " : "") << piece.motions[k];
    message << "; ";
  }
  message << "hold it there, by prescribed velocities of 0 or a rigid boundary";
  throw ConfigError(message.str());
}

} // namespace bergamo::fe
