#include "fe_dealii/mesh/box_mesh.h"

#include "dem/core/error.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <cmath>
#include <sstream>
#include <vector>

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
      throw ConfigError(message.str());
    }
    if (subdivisions[i] == 0)
    {
      message << "box mesh: subdivisions along "
              << "xyz"[i] << " = 0 is not allowed; give at least 1";
      throw ConfigError(message.str());
    }
    if (!(grading[i] > 0) || !std::isfinite(grading[i]))
    {
      message << "box mesh: grading along "
              << "xyz"[i] << " = " << grading[i] << " is not allowed; give a positive number, 1 for equal bricks";
      throw ConfigError(message.str());
    }
  }
}

namespace
{

/// Edges of n bricks that fill a length and grow by a constant ratio, the last `grading` times the first.
std::vector<double> graded_edges(const double length, const unsigned int n, const double grading)
{
  const double ratio = n > 1 ? std::pow(grading, 1. / (n - 1)) : 1;
  std::vector<double> edges(n, 1);
  double whole = 1;
  for (unsigned int k = 1; k < n; ++k)
    whole += edges[k] = edges[k - 1] * ratio;
  for (double &edge : edges)
    edge *= length / whole;
  return edges;
}

} // namespace

void make_box(const BoxMeshParameters &parameters, dealii::Triangulation<3, 3> &triangulation)
{
  parameters.validate();
  if (triangulation.n_levels() != 0)
    throw ConfigError("box mesh: the triangulation already holds " + std::to_string(triangulation.n_active_cells()) +
                      " cells; pass an empty one or call clear() first");
  const auto &[min, max, n, grading] = parameters;
  std::vector<std::vector<double>> edges;
  for (int i = 0; i < 3; ++i)
    edges.push_back(graded_edges(max[i] - min[i], n[i], grading[i]));
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, edges, dealii::Point<3>(min[0], min[1], min[2]),
                                                    dealii::Point<3>(max[0], max[1], max[2]),
                                                    /*colorize=*/true);
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_material_id(0); // deal.II colours octants, too
}

} // namespace bergamo::fe
