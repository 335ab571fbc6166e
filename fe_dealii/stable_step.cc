#include "fe_dealii/stable_step.h"

#include "fe_dealii/element/largest_eigenvalue.h"
#include "fe_dealii/moving_body.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace bergamo::fe
{

StableStep stable_step(const MovingBody &body)
{
  std::vector<double> eigenvalue(body.n_elements());
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < eigenvalue.size(); ++e)
    eigenvalue[e] = largest_eigenvalue(body.elements(), e, body.displacement().begin()) / body.mass_factor(e);
  const auto largest = std::max_element(eigenvalue.begin(), eigenvalue.end());
  return {2 / std::sqrt(*largest), *largest, std::size_t(largest - eigenvalue.begin())};
}

} // namespace bergamo::fe
