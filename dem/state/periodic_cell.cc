#include "dem/state/periodic_cell.h"

#include "dem/core/error.h"

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

void PeriodicCell::validate() const
{
  const bool is_open = (edges.array() == std::numeric_limits<double>::infinity()).all();
  require(is_open || (edges.allFinite() && edges.minCoeff() > 0.), "least edge of a periodic cell", edges.minCoeff(),
          "positive, and all three finite [m]; leave the cell out where nothing repeats itself");
  require(rate.allFinite() && drift_rate.allFinite() && acceleration.allFinite(), "rate of a periodic cell", rate.sum(),
          "finite [m/s]");
}

void PeriodicCell::advance(const double kick, const double drift)
{
  rate += kick * acceleration;
  drift_rate = rate;
  edges += drift * rate;
  motion += drift * rate.norm();
  update_images();
}

void PeriodicCell::update_images()
{
  for (int image = 0; image < n_images; ++image)
  {
    const Vec3 shift = shift_of(static_cast<Image>(image));
    place[image] = is_periodic() ? Vec3(shift.cwiseProduct(edges)) : Vec3(Vec3::Zero());
    velocity[image] = shift.cwiseProduct(drift_rate);
  }
}

} // namespace bergamo::dem
