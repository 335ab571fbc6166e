#include "fe_dealii/rotation.h"

#include "dem/core/parallel.h"
#include "fe_dealii/moving_body.h"

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace bergamo::fe
{
namespace
{

using Matrix = dealii::Tensor<2, 3>;

/// [degrees]
double rotation_of(const MovingBody &body, const std::size_t element)
{
  const std::array<double, 3> before = body.reference_centre(element), now = body.present_centre(element);
  Matrix moved, start; // Σ x ⊗ X and Σ X ⊗ X, from the centres
  for (const unsigned int node : body.element_nodes(element))
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        const std::array<double, 3> &place = body.node_position()[node];
        moved[i][j] += (place[i] + body.displacement()[3 * std::size_t(node) + i] - now[i]) * (place[j] - before[j]);
        start[i][j] += (place[i] - before[i]) * (place[j] - before[j]);
      }
  const double size = trace(start);
  if (!(determinant(start) > 1e-12 * size * size * size))
    return 0;
  // Higham (1986): the mean with the inverse transpose goes to the rotation of the polar decomposition.
  Matrix rotation = moved * invert(start);
  for (int k = 0; k < 20 && determinant(rotation) > 0; ++k)
    rotation = 0.5 * (rotation + transpose(invert(rotation)));
  // From the skew part, which small angles need, and the trace, which tells the large ones.
  const double x = rotation[2][1] - rotation[1][2], y = rotation[0][2] - rotation[2][0],
               z = rotation[1][0] - rotation[0][1];
  return std::atan2(std::sqrt(x * x + y * y + z * z), trace(rotation) - 1) * 180 / std::numbers::pi;
}

} // namespace

ElementRotation greatest_rotation(const MovingBody &body)
{
  std::vector<double> angle(body.n_elements());
  parallel_for(angle.size(),
               [&](const std::size_t e) { angle[e] = body.elements().is_rigid(e) ? 0 : rotation_of(body, e); });
  const auto greatest = std::max_element(angle.begin(), angle.end());
  return {*greatest, std::size_t(greatest - angle.begin())};
}

} // namespace bergamo::fe
