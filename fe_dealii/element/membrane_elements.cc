#include "fe_dealii/element/membrane_elements.h"

#include "dem/core/error.h"
#include "fe_dealii/element/cell_nodes.h"
#include "fe_dealii/element/difference_tangent.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace bergamo::fe
{

using math::sum;

constexpr int n_dofs = 3 * membrane::n_nodes;
// Square of the area over that in the reference: a millionth of the area, where rounding takes over.
constexpr double collapsed = 1e-12;

MembraneElements::MembraneElements(const Rubber &law, std::vector<unsigned int> nodes,
                                   std::vector<membrane::Geometry> geometry, const double thickness)
    : ElementGroup(membrane::n_nodes, std::move(nodes)), law_(law), geometry_(std::move(geometry)),
      thickness_(thickness), energy_(geometry_.size(), 0.)
{
}

std::optional<std::size_t> MembraneElements::compute_forces(const std::size_t begin, const std::size_t end,
                                                            const double *displacement, const double *)
{
  return std::visit(
      [&](const auto &law) -> std::optional<std::size_t>
      {
        for (std::size_t e = begin; e < end; ++e)
        {
          if (is_rigid(e))
            continue;
          double u[n_dofs];
          gather(e, displacement, u);
          const membrane::Response response = membrane::internal_force(law, geometry_[e], u, force(e));
          energy_[e] = response.energy;
          if (!std::isfinite(response.energy) || response.least_growth < collapsed)
            return e;
        }
        return std::nullopt;
      },
      law_);
}

void MembraneElements::lumped_mass(const std::size_t element, double *mass) const
{
  const double density = std::visit([](const auto &law) { return law.density(); }, law_);
  for (int node = 0; node < membrane::n_nodes; ++node)
  {
    mass[node] = 0;
    for (int point = 0; point < membrane::n_points; ++point)
      mass[node] += density * membrane::shape_value(node, point) * geometry_[element].volume[point];
  }
}

void MembraneElements::stiffness(const std::size_t element, const double *displacement, double *matrix) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  const membrane::Geometry &geometry = geometry_[element];
  const double size = std::sqrt(volume(element) / thickness_);
  std::visit(
      [&](const auto &law)
      {
        difference_tangent<n_dofs>([&](const double *moved, double *force)
                                   { membrane::internal_force(law, geometry, moved, force); },
                                   u, 1e-5 * size, matrix);
      },
      law_);
}

void MembraneElements::set_share(std::span<const double>)
{
  throw ConfigError("membrane: a two-scale model shares no membrane; choose a solid");
}

ElementState MembraneElements::state_of(const std::size_t element, const double *displacement) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  const membrane::Stretches stretch = membrane::stretches(geometry_[element], u);
  const membrane::Stresses stress = std::visit([&](const auto &law) { return membrane::stresses(law, stretch); }, law_);
  const membrane::Points fraction = geometry_[element].volume / volume(element);
  ElementState state;
  constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  for (int c = 0; c < 6; ++c)
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        state.stress[c] +=
            sum(fraction * stress.second_piola[a][b] * stretch.along[a][row[c]] * stretch.along[b][column[c]]);
  state.volume = volume(element); // it is incompressible
  state.energy_density = energy_[element] / volume(element);
  return state;
}

MembraneState MembraneElements::membrane_state_of(const std::size_t element, const double *displacement) const
{
  double u[n_dofs];
  gather(element, displacement, u);
  const membrane::Stretches stretch = membrane::stretches(geometry_[element], u);
  const membrane::Stresses stress = std::visit([&](const auto &law) { return membrane::stresses(law, stretch); }, law_);
  const membrane::Points &volume = geometry_[element].volume;
  MembraneState state;
  for (int k = 0; k < 2; ++k)
    state.principal_stress[k] = sum(volume * stress.principal[k]) / sum(volume);
  state.thickness = thickness_ * sum(volume) / sum(volume / math::sqrt(stretch.third));
  return state;
}

double MembraneElements::elastic_energy() const
{
  double energy = 0;
  for (const double e : energy_)
    energy += e;
  return energy;
}

std::unique_ptr<MembraneElements> make_membrane_elements(const dealii::DoFHandler<2, 3> &dof_handler, const Rubber &law,
                                                         const double thickness)
{
  // The area of a point where all nodes lie on one line is not zero but rounding.
  constexpr double rounding = 1e-12;
  std::vector<membrane::Geometry> geometries;
  for (const auto &cell : dof_handler.get_triangulation().active_cell_iterators())
  {
    std::array<std::array<double, 3>, membrane::n_nodes> nodes;
    for (int node = 0; node < membrane::n_nodes; ++node)
      for (int i = 0; i < 3; ++i)
        nodes[node][i] = cell->vertex(node)[i];
    geometries.push_back(membrane::reference_geometry(nodes, thickness));
    const double size = cell->diameter();
    for (int point = 0; point < membrane::n_points; ++point)
    {
      const double area = geometries.back().volume[point] / thickness;
      if (area > rounding * size * size)
        continue;
      std::ostringstream message;
      message << "membrane: cell " << cell->active_cell_index() << " at (" << cell->center()
              << ") m is degenerate or folded over (area " << area << " m^2 at a quadrature point); repair the mesh";
      throw ConfigError(message.str());
    }
  }
  return std::make_unique<MembraneElements>(law, cell_nodes(dof_handler), std::move(geometries), thickness);
}

} // namespace bergamo::fe
