#include "fe_dealii/thin_layers.h"

#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace bergamo::fe
{
namespace
{

constexpr int n_faces = 6;
constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

using Vector = std::array<double, 3>;

/// Nodes of a face: number 2*axis + side.
std::array<unsigned int, 4> face_nodes(const MovingBody &body, const std::size_t element, const int face)
{
  std::array<unsigned int, 4> nodes{};
  int n = 0;
  for (int node = 0; node < 8; ++node)
    if (((node >> (face / 2)) & 1) == face % 2)
      nodes[n++] = body.element_nodes(element)[node];
  return nodes;
}

Vector centre(const MovingBody &body, const std::array<unsigned int, 4> &nodes)
{
  Vector sum{};
  for (const unsigned int node : nodes)
    for (int i = 0; i < 3; ++i)
      sum[i] += body.node_position()[node][i] / 4;
  return sum;
}

/// From one face across an axis to the other.
Vector across(const MovingBody &body, const std::size_t element, const int axis)
{
  const Vector start = centre(body, face_nodes(body, element, 2 * axis)),
               end = centre(body, face_nodes(body, element, 2 * axis + 1));
  return {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
}

double length(const Vector &v)
{
  return std::hypot(v[0], v[1], v[2]);
}

struct Side // of a face
{
  std::size_t element = nobody;
  int face = 0;
};

/// What lies on the other side of each face, by 6*element + face.
std::vector<Side> neighbours(const MovingBody &body)
{
  struct Face
  {
    std::array<unsigned int, 4> nodes;
    Side side;
  };
  std::vector<Face> faces;
  for (std::size_t e = 0; e < body.n_elements(); ++e)
    for (int face = 0; face < n_faces; ++face)
    {
      faces.push_back({face_nodes(body, e, face), {e, face}});
      std::sort(faces.back().nodes.begin(), faces.back().nodes.end());
    }
  std::sort(faces.begin(), faces.end(),
            [](const Face &a, const Face &b)
            { return std::tie(a.nodes, a.side.element) < std::tie(b.nodes, b.side.element); });
  std::vector<Side> result(n_faces * body.n_elements());
  for (std::size_t k = 1; k < faces.size(); ++k)
    if (faces[k].nodes == faces[k - 1].nodes)
    {
      const Side &a = faces[k].side, &b = faces[k - 1].side;
      result[n_faces * a.element + a.face] = b;
      result[n_faces * b.element + b.face] = a;
    }
  return result;
}

/// Elements on top of each other across an axis of one of them.
struct Stack
{
  int n_layers = 1;
  double thickness = 0; // of the layers together [m]
  Side ends[2];         // their outer faces
};

struct Axis
{
  std::size_t element;
  int axis;
};

/// To the surfaces on both sides, or until it is thick enough [m].
Stack stack_of(const MovingBody &body, const std::vector<Side> &other_side, const Axis &start,
               const double thick_enough)
{
  Stack stack;
  stack.thickness = length(across(body, start.element, start.axis));
  for (int side = 0; side < 2; ++side)
  {
    Side &end = stack.ends[side] = {start.element, 2 * start.axis + side};
    while (stack.n_layers == 1 || stack.thickness < thick_enough)
    {
      const Side next = other_side[n_faces * end.element + end.face];
      if (next.element == nobody)
        break;
      end = {next.element, next.face ^ 1};
      stack.thickness += length(across(body, next.element, next.face / 2));
      ++stack.n_layers;
    }
  }
  return stack;
}

/// Whether all nodes of a face have a prescribed motion in each direction that a layer has across.
bool is_held(const MovingBody &body, const Side &side, const Vector &across)
{
  for (const unsigned int node : face_nodes(body, side.element, side.face))
    for (int i = 0; i < 3; ++i)
      if (std::abs(across[i]) > 0.5 * length(across) && !body.constraint_of(3 * std::size_t(node) + i))
        return false;
  return true;
}

/// Diagonal of the box around a body [m].
double extent(const MovingBody &body)
{
  Vector low = body.node_position().front(), high = low;
  for (const Vector &place : body.node_position())
    for (int i = 0; i < 3; ++i)
    {
      low[i] = std::min(low[i], place[i]);
      high[i] = std::max(high[i], place[i]);
    }
  return length({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

} // namespace

ThinLayers thin_layers(const MovingBody &body)
{
  ThinLayers result;
  if (body.elements().bends())
    return result;
  const std::vector<Side> other_side = neighbours(body);
  const double size = extent(body);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    if (body.elements().is_rigid(e))
      continue;
    bool is_thin = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector direction = across(body, e, axis);
      const double along = std::max(length(across(body, e, (axis + 1) % 3)), length(across(body, e, (axis + 2) % 3)));
      const double thick_enough = along / longest_in_thickness;
      const Stack stack = stack_of(body, other_side, {e, axis}, thick_enough);
      if ((stack.n_layers > 1 && stack.thickness >= thick_enough) || size <= least_slenderness * stack.thickness ||
          is_held(body, stack.ends[0], direction) || is_held(body, stack.ends[1], direction))
        continue;
      is_thin = true;
      if (along * result.thickness > result.length * stack.thickness || result.n_layers == 0)
        result = {result.n_elements, e, stack.n_layers, stack.thickness, along};
    }
    result.n_elements += is_thin;
  }
  return result;
}

} // namespace bergamo::fe
