#include "dem/state/periodic_cell.h"

#include <cmath>

namespace bergamo::dem
{

PeriodicCell::PeriodicCell() : PeriodicCell(Vec3::Constant(std::numeric_limits<double>::infinity())) {}

PeriodicCell::PeriodicCell(const Vec3 &edges) : edges(edges)
{
  update_images();
}

Image PeriodicCell::nearest_image(const Vec3 &line) const
{
  int image = own_image;
  for (int d = 0, stride = 1; d < 3; ++d, stride *= 3)
    image += line[d] > 0.5 * edges[d] ? -stride : line[d] < -0.5 * edges[d] ? stride : 0;
  return static_cast<Image>(image);
}

void PeriodicCell::advance(const double time_step)
{
  rate += time_step * acceleration;
  edges += time_step * rate;
  motion += time_step * rate.norm();
  update_images();
}

void PeriodicCell::update_images()
{
  for (int image = 0; image < n_images; ++image)
  {
    const Vec3 shift = shift_of(static_cast<Image>(image));
    place[image] = is_periodic() ? Vec3(shift.cwiseProduct(edges)) : Vec3(Vec3::Zero());
    velocity[image] = shift.cwiseProduct(rate);
  }
}

} // namespace bergamo::dem
