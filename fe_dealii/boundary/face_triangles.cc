#include "fe_dealii/boundary/face_triangles.h"

#include "dem/core/error.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

namespace bergamo::fe
{
namespace
{

/// Lagrange's polynomials of degree 1 or 2 at k/n, times n^degree: integers.
std::array<std::int64_t, 3> shape_values(const int degree, const std::int64_t k, const std::int64_t n)
{
  if (degree == 1)
    return {n - k, k, 0};
  return {(n - k) * (n - 2 * k), 4 * k * (n - k), k * (2 * k - n)};
}

/// Nodes of a corner with their N_i times a common denominator, none of them 0. Integers tell whether corners of two
/// faces are one, whichever way round these are numbered.
using CornerKey = std::vector<std::pair<unsigned int, std::int64_t>>;

struct FacePoint // i/n, j/n of a face
{
  std::int64_t i, j, n;
};

CornerKey key_of(const Surface &surface, const std::size_t face, const FacePoint &at)
{
  const auto along_1 = shape_values(surface.degree, at.i, at.n), along_2 = shape_values(surface.degree, at.j, at.n);
  CornerKey key;
  for (int b = 0; b <= surface.degree; ++b)
    for (int a = 0; a <= surface.degree; ++a)
      if (const std::int64_t value = along_1[a] * along_2[b]; value != 0)
        key.emplace_back(surface.face(face)[(surface.degree + 1) * b + a], value);
  std::sort(key.begin(), key.end());
  return key;
}

Rows<FaceTriangles::Share> rows_of(const std::vector<std::vector<FaceTriangles::Share>> &corners)
{
  return {corners.size(), [&](const auto &put)
          {
            for (std::size_t corner = 0; corner < corners.size(); ++corner)
              for (const FaceTriangles::Share &share : corners[corner])
                put(corner, share);
          }};
}

std::vector<std::vector<FaceTriangles::Share>> copy_of(const Rows<FaceTriangles::Share> &corners)
{
  std::vector<std::vector<FaceTriangles::Share>> copy;
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
    copy.emplace_back(corners[corner].begin(), corners[corner].end());
  return copy;
}

/// Triangles by their sides.
using Side = std::pair<unsigned int, unsigned int>;
std::map<Side, std::vector<std::size_t>> triangles_by_side(const std::vector<std::array<unsigned int, 3>> &triangles)
{
  std::map<Side, std::vector<std::size_t>> by_side;
  for (std::size_t k = 0; k < triangles.size(); ++k)
    for (int i = 0; i < 3; ++i)
      by_side[std::minmax(triangles[k][i], triangles[k][(i + 1) % 3])].push_back(k);
  return by_side;
}

/// Whether a corner lies on a side that one triangle alone has, by corner.
std::vector<bool> find_rim(const FaceTriangles &faces)
{
  std::vector<bool> is_on_rim(faces.corners.size(), false);
  for (const auto &[side, triangles] : triangles_by_side(faces.triangles))
    if (triangles.size() == 1)
      is_on_rim[side.first] = is_on_rim[side.second] = true;
  return is_on_rim;
}

/// Puts a corner in the middle of a side, and cuts the triangles beside it there.
void cut(FaceTriangles &faces, std::vector<std::vector<FaceTriangles::Share>> &corners, const Side &side)
{
  std::map<unsigned int, double> shares;
  for (const unsigned int end : {side.first, side.second})
    for (const auto &[node, value] : corners[end])
      shares[node] += 0.5 * value;
  const auto middle = static_cast<unsigned int>(corners.size());
  corners.emplace_back();
  for (const auto &[node, value] : shares)
    corners.back().push_back({node, value});
  for (std::size_t k = faces.triangles.size(); k-- > 0;)
  {
    auto half = faces.triangles[k];
    const auto first = std::find(half.begin(), half.end(), side.first),
               second = std::find(half.begin(), half.end(), side.second);
    if (first == half.end() || second == half.end())
      continue;
    *std::find(faces.triangles[k].begin(), faces.triangles[k].end(), side.first) = middle;
    *second = middle;
    faces.triangles.push_back(half);
  }
}

} // namespace

FaceTriangles divide_faces(const std::span<const Surface> surfaces, const unsigned int n_squares)
{
  require(n_squares >= 1, "number of squares along the side of a face", n_squares, "at least 1");
  FaceTriangles result;
  std::vector<std::vector<FaceTriangles::Share>> corners;
  std::map<CornerKey, unsigned int> known;
  const auto pattern = grid_triangles(n_squares);
  for (const Surface &surface : surfaces)
    for (std::size_t face = 0; face < surface.size(); ++face)
    {
      std::vector<unsigned int> of_face;
      for (unsigned int j = 0; j <= n_squares; ++j)
        for (unsigned int i = 0; i <= n_squares; ++i)
        {
          const CornerKey key = key_of(surface, face, {i, j, n_squares});
          const auto [place, is_new] = known.emplace(key, static_cast<unsigned int>(corners.size()));
          of_face.push_back(place->second);
          if (!is_new)
            continue;
          std::int64_t denominator = 0; // the N_i add up to 1
          for (const auto &[node, value] : key)
            denominator += value;
          corners.emplace_back();
          for (const auto &[node, value] : key)
            corners.back().push_back({node, static_cast<double>(value) / static_cast<double>(denominator)});
        }
      for (const auto &[a, b, c] : pattern)
        result.triangles.push_back({of_face[a], of_face[b], of_face[c]});
    }
  result.corners = rows_of(corners);
  return result;
}

/// Both sides have the corners of the rim in common, but no sides of triangles beside it: such a one that goes from rim
/// to rim is cut in its middle.
FaceTriangles both_sides(const FaceTriangles &front)
{
  FaceTriangles both = front;
  std::vector<std::vector<FaceTriangles::Share>> corners = copy_of(front.corners);
  std::vector<bool> is_on_rim = find_rim(front);
  for (const auto &[side, triangles] : triangles_by_side(front.triangles))
    if (triangles.size() == 2 && is_on_rim[side.first] && is_on_rim[side.second])
      cut(both, corners, side);
  is_on_rim.resize(corners.size(), false);
  std::vector<unsigned int> back(corners.size());
  for (unsigned int corner = 0; corner < back.size(); ++corner)
  {
    back[corner] = is_on_rim[corner] ? corner : static_cast<unsigned int>(corners.size());
    if (!is_on_rim[corner])
      corners.push_back(std::vector(corners[corner]));
  }
  for (std::size_t k = 0, n = both.triangles.size(); k < n; ++k)
  {
    const auto [a, b, c] = both.triangles[k];
    both.triangles.push_back({back[a], back[c], back[b]});
  }
  both.corners = rows_of(corners);
  return both;
}

} // namespace bergamo::fe
