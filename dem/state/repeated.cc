#include "dem/state/repeated.h"

#include "dem/core/error.h"

#include <algorithm>
#include <string>

namespace bergamo::dem
{

std::pair<int, Image> CellCopies::seen_from(const int copy, const Image image) const
{
  const std::array<int, 3> from = place_of(copy);
  int other = 0, seen = own_image;
  for (int d = 0, copies_below = 1, stride = 1; d < 3; ++d, copies_below *= n_along[d - 1], stride *= 3)
  {
    const int shift = static_cast<int>(shift_of(image)[d]);
    const int to = from[d] + shift, beyond = to < 0 ? -1 : to >= n_along[d] ? 1 : 0;
    other += copies_below * (to - beyond * n_along[d]);
    seen += stride * beyond;
  }
  return {other, static_cast<Image>(seen)};
}

void CellCopies::validate(const PeriodicCell &cell) const
{
  for (int d = 0; d < 3; ++d)
  {
    const std::string name = std::string("number of copies of a periodic cell along ") + "xyz"[d];
    require(n_along[d] >= 1, name, n_along[d], "at least 1");
    require(n_along[d] == 1 || cell.is_periodic(d), name, n_along[d], "1, where the cell does not repeat itself");
  }
}

Particles repeated(const Particles &cell, const CellCopies &copies)
{
  copies.validate(cell.cell);
  Particles one = cell;
  for (auto *forces : {&one.external_force, &one.external_torque, &one.transfer_force, &one.transfer_torque})
    forces->clear();
  const std::int64_t n_ids = one.id.empty() ? 0 : 1 + *std::max_element(one.id.begin(), one.id.end());
  Particles all = one;
  for (int copy = 1; copy < copies.n(); ++copy)
  {
    const std::array<int, 3> place = copies.place_of(copy);
    const Vec3 shift = one.cell.period.cwiseProduct(Vec3(place[0], place[1], place[2])),
               faster = one.cell.rate.cwiseProduct(Vec3(place[0], place[1], place[2])),
               drift_faster = one.cell.drift_rate.cwiseProduct(Vec3(place[0], place[1], place[2]));
    for (std::size_t i = 0; i < one.size(); ++i)
    {
      all.append(one, i, copy * n_ids + one.id[i]);
      all.position.back() += shift;
      all.velocity.back() += faster;
      all.drift_velocity.back() += drift_faster;
    }
  }
  PeriodicCell &many = all.cell;
  const Vec3 n_along(copies.n_along[0], copies.n_along[1], copies.n_along[2]);
  for (Vec3 *lengths : {&many.edges, &many.rate, &many.drift_rate, &many.acceleration})
    *lengths = lengths->cwiseProduct(n_along);
  many.update_images();
  return all;
}

} // namespace bergamo::dem
