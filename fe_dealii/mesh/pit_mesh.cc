#include "fe_dealii/mesh/pit_mesh.h"

#include "dem/core/error.h"
#include "fe_dealii/mesh/mesh_check.h"

#include <deal.II/base/table.h>
#include <deal.II/base/types.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <cmath>

namespace bergamo::fe
{
namespace
{

using Planes = std::array<std::vector<double>, 3>;

/// Where each outer face lies; the planes' places are sums of steps in the mesh, so they are met up to rounding.
void set_boundary_ids(const Planes &planes, dealii::Triangulation<3> &mesh)
{
  const auto id_at = [&](const dealii::Point<3> &centre)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (unsigned int side = 0; side < 2; ++side)
      {
        const double plane = side == 0 ? planes[axis].front() : planes[axis].back();
        if (std::abs(centre[axis] - plane) < 1e-9 * (planes[axis].back() - planes[axis].front()))
          return 2 * axis + side;
      }
    return pit_faces;
  };
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(id_at(face->center()));
}

} // namespace

void PitMeshParameters::validate() const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (planes[axis].size() < 2)
      reject("pit mesh: there are ", planes[axis].size(), " planes across ", "xyz"[axis], "; give at least 2");
    for (std::size_t k = 1; k < planes[axis].size(); ++k)
      if (!(planes[axis][k] > planes[axis][k - 1]) || !std::isfinite(planes[axis][k] - planes[axis][k - 1]))
        reject("pit mesh: across ", "xyz"[axis], " a plane at ", planes[axis][k], " m follows one at ",
               planes[axis][k - 1], " m; let finite places ascend");
    if (!(hole_maximum[axis] >= hole_minimum[axis]))
      reject("pit mesh: the hole reaches along ", "xyz"[axis], " from ", hole_minimum[axis], " to ", hole_maximum[axis],
             " m; let the maximum be the greater one");
  }
}

void make_pit(const PitMeshParameters &parameters, dealii::Triangulation<3, 3> &triangulation)
{
  parameters.validate();
  if (triangulation.n_levels() != 0)
    reject("pit mesh: the triangulation already holds ", triangulation.n_active_cells(),
           " cells; pass an empty one or call clear() first");
  const Planes &planes = parameters.planes;
  std::vector<std::vector<double>> steps(3);
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t k = 1; k < planes[axis].size(); ++k)
      steps[axis].push_back(planes[axis][k] - planes[axis][k - 1]);

  const auto is_in_hole = [&](const std::array<std::size_t, 3> &cell)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double centre = 0.5 * (planes[axis][cell[axis]] + planes[axis][cell[axis] + 1]);
      if (!(centre > parameters.hole_minimum[axis] && centre < parameters.hole_maximum[axis]))
        return false;
    }
    return true;
  };
  dealii::Table<3, dealii::types::material_id> material(steps[0].size(), steps[1].size(), steps[2].size());
  std::size_t n_left = 0;
  for (std::size_t i = 0; i < steps[0].size(); ++i)
    for (std::size_t j = 0; j < steps[1].size(); ++j)
      for (std::size_t k = 0; k < steps[2].size(); ++k)
      {
        const bool is_taken = is_in_hole({i, j, k});
        material(i, j, k) = is_taken ? dealii::numbers::invalid_material_id : 0;
        n_left += !is_taken;
      }
  if (n_left == 0)
    reject("pit mesh: the hole leaves no brick; let the planes reach beyond it");
  dealii::GridGenerator::subdivided_hyper_rectangle(
      triangulation, steps, dealii::Point<3>(planes[0].front(), planes[1].front(), planes[2].front()), material);
  set_boundary_ids(planes, triangulation);
  check_mesh(triangulation);
}

std::vector<double> graded_planes(const double length, const double step, const double ratio)
{
  std::vector<double> places{0.};
  if (!(length > 0.))
    return places;
  for (double next = step; places.back() < length * (1. - 1e-9); next *= ratio)
    places.push_back(places.back() + next);
  const double shrinkage = length / places.back();
  for (double &place : places)
    place *= shrinkage;
  places.back() = length;
  return places;
}

} // namespace bergamo::fe
