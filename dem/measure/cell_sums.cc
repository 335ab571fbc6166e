#include "dem/measure/cell_sums.h"

#include "dem/measure/contact_list.h"

#include <algorithm>
#include <cmath>

namespace bergamo::dem
{

CellSums::CellSums(const HexahedronGrid &grid) : grid_(grid)
{
  grid.validate();
  edges_ = grid.cell_edges();
  sums_.assign(grid.size(), Mat3::Zero());
}

double CellSums::in_cells(const double place, const int axis) const
{
  return (place - grid_.box.low[axis]) / edges_[axis];
}

int CellSums::cell_at(const double place, const int axis) const
{
  if (!is_cut(axis))
    return 0;
  return static_cast<int>(std::floor(std::clamp(in_cells(place, axis), -1., double(grid_.n_cells[axis]))));
}

CellSums::Range CellSums::cells_between(const double low, const double high, const int axis) const
{
  return {std::max(0, cell_at(low, axis)), std::min(grid_.n_cells[axis] - 1, cell_at(high, axis))};
}

double CellSums::part_of(const double low, const double high, const int cell, const int axis) const
{
  if (!is_cut(axis))
    return 1.;
  if (high <= low)
    return cell == cell_at(low, axis) ? 1. : 0.;
  const double from = std::max(in_cells(low, axis), double(cell)), to = std::min(in_cells(high, axis), cell + 1.);
  return std::max(0., to - from) * edges_[axis] / (high - low);
}

void CellSums::add_at(const Vec3 &place, const Mat3 &stress_volume)
{
  std::size_t number = 0;
  for (int axis = 2; axis >= 0; --axis)
  {
    const int cell = cell_at(place[axis], axis);
    if (cell < 0 || cell >= grid_.n_cells[axis])
      return;
    number = number * grid_.n_cells[axis] + cell;
  }
  sums_[number] += stress_volume;
}

void CellSums::add_along(const Vec3 &from, const Vec3 &to, const Mat3 &stress_volume)
{
  std::vector<double> cuts{0., 1.}; // as parts of the way
  for (int axis = 0; axis < 3; ++axis)
  {
    const double begin = in_cells(from[axis], axis), end = in_cells(to[axis], axis);
    if (!is_cut(axis) || begin == end)
      continue;
    const double first = std::ceil(std::max(0., std::min(begin, end))),
                 last = std::floor(std::min<double>(grid_.n_cells[axis], std::max(begin, end)));
    for (double plane = first; plane <= last; ++plane)
      cuts.push_back(std::clamp((plane - begin) / (end - begin), 0., 1.));
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 1; k < cuts.size(); ++k)
    if (cuts[k] > cuts[k - 1])
      add_at(from + 0.5 * (cuts[k - 1] + cuts[k]) * (to - from), (cuts[k] - cuts[k - 1]) * stress_volume);
}

void CellSums::add_within(const Box &box, const Mat3 &stress_volume)
{
  const auto between = [&](const int axis) { return cells_between(box.low[axis], box.high[axis], axis); };
  const auto part = [&](const int cell, const int axis) { return part_of(box.low[axis], box.high[axis], cell, axis); };
  const Range x = between(0), y = between(1), z = between(2);
  for (int k = z.first; k <= z.last; ++k)
    for (int j = y.first; j <= y.last; ++j)
      for (int i = x.first; i <= x.last; ++i)
        sums_[i + grid_.n_cells[0] * (j + std::size_t(1) * grid_.n_cells[1] * k)] +=
            part(i, 0) * part(j, 1) * part(k, 2) * stress_volume;
}

std::vector<Vec3> CellSums::shifts(const PeriodicCell &cell) const
{
  std::vector<Vec3> shifts{Vec3::Zero()};
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!is_cut(axis) || !cell.is_periodic(axis))
      continue;
    const std::vector<Vec3> before = shifts;
    for (const double sign : {-1., 1.})
      for (const Vec3 &shift : before)
        shifts.emplace_back(shift + sign * cell.edges[axis] * Vec3::Unit(axis));
  }
  return shifts;
}

std::vector<Mat3> CellSums::means() const
{
  std::vector<Mat3> means = sums_;
  for (Mat3 &mean : means)
    mean /= edges_.prod();
  return means;
}

void add_contacts(CellSums &cells, const std::span<const TouchingContact> contacts, const Particles &particles)
{
  for (const TouchingContact &contact : contacts)
  {
    const Vec3 &from = particles.position[contact.first];
    const Mat3 moment = contact.branch * force_on_body1(contact).transpose();
    for (const Vec3 &shift : cells.shifts(particles.cell))
      cells.add_along(from + shift, from + shift + contact.branch, moment);
  }
}

} // namespace bergamo::dem
