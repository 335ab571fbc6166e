#include "drivers/membrane_triaxial/membrane.h"

#include <deal.II/grid/tria.h>

#include <cmath>
#include <numbers>

namespace bergamo::driver
{
namespace
{

void make_mesh(const MembraneParameters &p, const Prism &prism, dealii::Triangulation<2, 3> &mesh)
{
  std::vector<dealii::Point<3>> vertices;
  for (unsigned int ring = 0; ring <= p.n_high; ++ring)
    for (unsigned int k = 0; k < p.n_around; ++k)
    {
      const double angle = 2. * std::numbers::pi * k / p.n_around;
      vertices.emplace_back(prism.radius * std::cos(angle), prism.radius * std::sin(angle),
                            prism.height * (static_cast<double>(ring) / p.n_high - 0.5));
    }
  std::vector<dealii::CellData<2>> cells;
  for (unsigned int ring = 0; ring < p.n_high; ++ring)
    for (unsigned int k = 0; k < p.n_around; ++k)
    {
      const unsigned int here = ring * p.n_around + k, next = ring * p.n_around + (k + 1) % p.n_around;
      cells.emplace_back().vertices = {next, here, next + p.n_around, here + p.n_around}; // backwards: looks inwards
    }
  mesh.create_triangulation(vertices, cells, dealii::SubCellData());
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &edge : cell->face_iterators())
      if (edge->at_boundary())
        edge->set_boundary_id(edge->center()[2] < 0. ? lower_rim : upper_rim);
}

} // namespace

std::unique_ptr<fe::MembraneBody> make_membrane(const MembraneParameters &p, const Prism &prism)
{
  dealii::Triangulation<2, 3> mesh;
  make_mesh(p, prism, mesh);
  return std::make_unique<fe::MembraneBody>(
      mesh, fe::MembraneBodyParameters{.material = fe::Ogden(p.rubber), .thickness = p.thickness});
}

fe::FaceTriangles faces_of(const fe::MembraneBody &membrane)
{
  const fe::Surface surface = fe::membrane_surface(membrane.dof_handler());
  return fe::divide_faces({&surface, 1}, 1);
}

MembraneShape::MembraneShape(const MembraneParameters &p, const fe::MembraneBody &membrane, const Prism &prism)
    : body(membrane), faces(fe::membrane_surface(membrane.dof_handler()), membrane.node_position()),
      n_rings(p.n_high + 1),
      rim_area(0.5 * p.n_around * prism.radius * prism.radius * std::sin(2. * std::numbers::pi / p.n_around))
{
  for (const auto &place : membrane.node_position())
    ring_of.push_back(static_cast<std::size_t>(std::lround((place[2] / prism.height + 0.5) * p.n_high)));
}

double MembraneShape::volume(const double height) const
{
  return height * rim_area / 3. - faces.volume(body.displacement());
}

std::vector<double> MembraneShape::radii() const
{
  std::vector<double> sum(n_rings), count(n_rings);
  for (std::size_t node = 0; node < ring_of.size(); ++node)
  {
    const auto &start = body.node_position()[node];
    const auto moved = body.displacement().subspan(3 * node, 2);
    sum[ring_of[node]] += std::hypot(start[0] + moved[0], start[1] + moved[1]);
    ++count[ring_of[node]];
  }
  for (std::size_t ring = 0; ring < n_rings; ++ring)
    sum[ring] /= count[ring];
  return sum;
}

} // namespace bergamo::driver
