#include "fe_dealii/box_mesh.h"

#include "fe_dealii/error.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <sstream>

namespace bergamo::fe
{

void BoxMeshParameters::validate() const
{
  for (int i = 0; i < 3; ++i)
  {
    std::ostringstream message;
    if (!(maximum[i] > minimum[i]) || !std::isfinite(maximum[i] - minimum[i]))
    {
      message << "box mesh: along "
              << "xyz"[i] << " it reaches from " << minimum[i] << " to " << maximum[i]
              << " m; the maximum must exceed the minimum and both must be finite";
      throw ParameterError(message.str());
    }
    if (subdivisions[i] == 0)
    {
      message << "box mesh: subdivisions along "
              << "xyz"[i] << " = 0 is not allowed; give at least 1";
      throw ParameterError(message.str());
    }
  }
}

void make_box(const BoxMeshParameters &parameters, dealii::Triangulation<3, 3> &triangulation)
{
  parameters.validate();
  if (triangulation.n_levels() != 0)
    throw ParameterError("box mesh: the triangulation already holds " + std::to_string(triangulation.n_active_cells()) +
                         " cells; pass an empty one or call clear() first");
  const auto &[min, max, n] = parameters;
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {n[0], n[1], n[2]},
                                                    dealii::Point<3>(min[0], min[1], min[2]),
                                                    dealii::Point<3>(max[0], max[1], max[2]),
                                                    /*colorize=*/true);
}

} // namespace bergamo::fe
