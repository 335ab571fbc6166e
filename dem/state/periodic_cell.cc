#include "dem/state/periodic_cell.h"

#include "dem/core/error.h"

#include <algorithm>
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
  for (int d = 0; d < 3; ++d)
  {
    require(edges[d] > 0., std::string("edge of a periodic cell along ") + "xyz"[d], edges[d],
            "positive, or infinite in a direction in which nothing repeats itself [m]");
    const double fastest = std::max({std::abs(rate[d]), std::abs(drift_rate[d]), std::abs(acceleration[d])});
    require(is_periodic(d) || fastest == 0., std::string("rate of a periodic cell along ") + "xyz"[d], fastest,
            "zero where its edge is infinite [m/s, m/s^2]");
  }
  require(rate.allFinite() && drift_rate.allFinite() && acceleration.allFinite(), "rate of a periodic cell", rate.sum(),
          "finite [m/s]");
}

void PeriodicCell::require_closed(const char *what) const
{
  if (is_closed())
    return;
  throw ConfigError(std::string(what) +
                    (is_periodic()
                         ? " needs a periodic cell with three finite edges, but this one repeats itself along " +
                               directions() + " alone: give it the others"
                         : " needs a periodic cell, but nothing repeats itself: give the grains one"));
}

std::string PeriodicCell::directions() const
{
  std::string names;
  int left = is_periodic(0) + is_periodic(1) + is_periodic(2);
  for (int d = 0; d < 3; ++d)
    if (is_periodic(d))
    {
      --left;
      names += "xyz"[d];
      names += left > 1 ? ", " : left == 1 ? " and " : "";
    }
  return names;
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
  for (int d = 0; d < 3; ++d)
    period[d] = is_periodic(d) ? edges[d] : 0.;
  for (int image = 0; image < n_images; ++image)
  {
    const Vec3 shift = shift_of(static_cast<Image>(image));
    place[image] = shift.cwiseProduct(period);
    velocity[image] = shift.cwiseProduct(drift_rate);
  }
}

} // namespace bergamo::dem
