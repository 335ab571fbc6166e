#include "drivers/rubber_block/block.h"

#include "fe_dealii/mesh/box_mesh.h"
#include "fe_dealii/mesh/material_box.h"

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace bergamo::driver
{
namespace
{

using Mesh = dealii::Triangulation<3, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();

enum MaterialId : unsigned int
{
  rubber_id,
  top_id
};

std::set<Mesh::active_cell_iterator> cells_of_notch(const BlockParameters &p, const Vec3 &corner, const Mesh &box)
{
  const double half_length = 0.5 * p.edges[0] * p.notch_along / p.n_along;
  const double middle = corner[0] + 0.5 * p.edges[0];
  const double height = corner[2] + p.edges[2] * p.notch_high / p.n_high;
  std::set<Mesh::active_cell_iterator> cells;
  for (const auto &cell : box.active_cell_iterators())
    if (std::abs(cell->center()[0] - middle) < half_length && cell->center()[2] < height)
      cells.insert(cell);
  return cells;
}

} // namespace

std::unique_ptr<fe::ExplicitBody> make_block(const BlockParameters &p, const Vec3 &corner, const double gravity)
{
  const Vec3 end = corner + p.edges;
  Mesh box, mesh;
  fe::make_box({{corner[0], corner[1], corner[2]}, {end[0], end[1], end[2]}, {p.n_along, p.n_across, p.n_high}}, box);
  dealii::GridGenerator::create_triangulation_with_removed_cells(box, cells_of_notch(p, corner, box), mesh);
  const double layer = p.edges[2] / p.n_high;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(face->center()[2] > end[2] - 0.25 * layer ? block_top : block_sides);
  fe::set_material({{-infinity, -infinity, end[2] - p.top_layers * layer}, {infinity, infinity, infinity}, top_id},
                   mesh);
  fe::ExplicitBodyParameters body;
  body.layers = {{rubber_id, fe::MooneyRivlin(p.rubber)}, {top_id, fe::NeoHooke(p.top)}};
  body.degree = p.element == BlockElement::quadratic ? 2 : 1;
  body.kind.hourglass = p.element == BlockElement::bending ? fe::Hourglass::bending : fe::Hourglass::at_points;
  body.gravity = {0., 0., -gravity};
  return std::make_unique<fe::ExplicitBody>(mesh, body);
}

fe::FaceTriangles block_faces(const fe::ExplicitBody &block, const BlockParameters &p)
{
  const std::array surfaces = {fe::boundary_surface(block.dof_handler(), block_sides),
                               fe::boundary_surface(block.dof_handler(), block_top)};
  return fe::divide_faces(surfaces, p.squares);
}

} // namespace bergamo::driver
