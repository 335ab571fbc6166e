#include "coupling/adapter/cell_stress.h"

#include "dem/measure/cell_sums.h"

#include <array>

namespace bergamo::coupling
{
namespace
{

constexpr int n_corners = 8;

/// The corners of an element: x first, then y, then z, as in deal.II.
struct Corners
{
  std::array<Vec3, n_corners> place;
  std::array<double, n_corners> share;
};

/// Linear in each local coordinate from 0 to 1.
template <class Value>
Value at(const std::array<Value, n_corners> &values, const Vec3 &local)
{
  Value value = 0. * values[0];
  for (int corner = 0; corner < n_corners; ++corner)
  {
    double shape = 1.;
    for (int axis = 0; axis < 3; ++axis)
      shape *= corner >> axis & 1 ? local[axis] : 1. - local[axis];
    value += shape * values[corner];
  }
  return value;
}

/// @param part of the element, from 0 to 63
void add_part(dem::CellSums &cells, const Corners &corners, const int part, const Mat3 &stress_volume)
{
  constexpr int n = 4;
  const Vec3 first = Vec3(part % n, part / n % n, part / (n * n)) / n;
  dem::Box box{at(corners.place, first), at(corners.place, first)};
  for (int corner = 1; corner < n_corners; ++corner)
  {
    const Vec3 place = at(corners.place, first + Vec3(corner & 1, corner >> 1 & 1, corner >> 2) / n);
    box.low = box.low.cwiseMin(place);
    box.high = box.high.cwiseMax(place);
  }
  const double share = at(corners.share, first + Vec3::Constant(0.5 / n));
  cells.add_within(box, share / (n * n * n) * stress_volume);
}

/// @param s xx yy zz xy yz zx
Mat3 tensor_of(const fe::Stress &s)
{
  Mat3 tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

std::vector<Mat3> of_grains(const dem::Simulation &grains, const dem::HexahedronGrid &grid)
{
  dem::CellSums cells(grid);
  dem::add_contacts(cells, grains.contacts.touching(grains.particles), grains.particles);
  dem::add_contacts(cells, grains.contacts.touching_walls(grains.particles), grains.particles);
  return cells.means();
}

std::vector<Mat3> of_continuum(const fe::ExplicitBody &body, const std::span<const double> weight_of_grains,
                               const dem::HexahedronGrid &grid)
{
  dem::CellSums cells(grid);
  for (std::size_t element = 0; element < body.n_elements(); ++element)
  {
    Corners corners;
    const auto nodes = body.element_nodes(element);
    for (int corner = 0; corner < n_corners; ++corner)
    {
      const unsigned int node = nodes[corner];
      for (int d = 0; d < 3; ++d)
        corners.place[corner][d] = body.node_position()[node][d] + body.displacement()[3 * node + d];
      corners.share[corner] = weight_of_grains.empty() ? 1. : 1. - weight_of_grains[node];
    }
    const fe::ElementState state = body.state_of(element);
    const Mat3 stress_volume = state.volume * tensor_of(state.stress);
    for (int part = 0; part < 64; ++part)
      add_part(cells, corners, part, stress_volume);
  }
  return cells.means();
}

} // namespace

std::vector<CellStress> cell_stresses(const TwoScaleModel &model, const dem::HexahedronGrid &grid)
{
  std::vector<CellStress> cells =
      model.grains() ? cell_stresses(*model.grains(), grid) : std::vector<CellStress>(grid.size());
  if (model.body())
  {
    const std::vector<Mat3> continuum = of_continuum(*model.body(), model.weight_of_grains(), grid);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      cells[cell].continuum = continuum[cell];
  }
  return cells;
}

std::vector<CellStress> cell_stresses(const dem::Simulation &grains, const dem::HexahedronGrid &grid)
{
  std::vector<CellStress> cells(grid.size());
  const std::vector<Mat3> stress = of_grains(grains, grid);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
    cells[cell].grains = stress[cell];
  return cells;
}

} // namespace bergamo::coupling
