#include "drivers/brachistochrone/path.h"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace bergamo::driver
{
namespace
{

class Plane : public Path
{
public:
  explicit Plane(const Vec3 &end) : end_(end) {}

  Vec3 at(const double share) const override { return share * share * end_; }
  double travel_time(const double gravity) const override
  {
    return end_.norm() * std::sqrt(2. / (gravity * -end_.z()));
  }
  double distance(const Vec3 &place, double) const override
  {
    return place.dot(end_.normalized().cross(Vec3::UnitY()));
  }

private:
  Vec3 end_;
};

/// x = a (t - sin t), z = -a (1 - cos t); under gravity t grows evenly, as sqrt(g / a).
class Cycloid : public Path
{
public:
  explicit Cycloid(const Vec3 &end) : angle_(angle_to(end)), radius_(-end.z() / (1. - std::cos(angle_))) {}

  Vec3 at(const double share) const override
  {
    const double t = share * angle_;
    return radius_ * Vec3(t - std::sin(t), 0., -(1. - std::cos(t)));
  }
  double travel_time(const double gravity) const override { return angle_ * std::sqrt(radius_ / gravity); }
  double distance(const Vec3 &place, double share) const override;

private:
  static double angle_to(const Vec3 &end);

  double angle_;  // t at the end
  double radius_; // a of the rolling circle [m]
};

double Cycloid::angle_to(const Vec3 &end)
{
  const double slope = end.x() / -end.z();
  const auto miss = [&](const double t) { return t - std::sin(t) - slope * (1. - std::cos(t)); };
  std::uintmax_t n_steps = 200;
  const auto [low, high] = // below 0 up to the smaller of 1 and the slope, above it after a whole turn
      boost::math::tools::toms748_solve(miss, std::min(1., slope), 2. * std::numbers::pi,
                                        boost::math::tools::eps_tolerance<double>(), n_steps);
  return 0.5 * (low + high);
}

double Cycloid::distance(const Vec3 &place, const double share) const
{
  constexpr double reach = 0.2;                                               // of the travel time, to both sides
  constexpr int half_of_the_digits = std::numeric_limits<double>::digits / 2; // what a least square can tell
  const auto square = [&](const double s) { return (place - at(s)).squaredNorm(); };
  const double nearest =
      boost::math::tools::brent_find_minima(square, std::max(0., share - reach), share + reach, half_of_the_digits)
          .first;
  const double t = 0.5 * angle_ * nearest;
  return (place - at(nearest)).dot(Vec3(std::cos(t), 0., std::sin(t)));
}

} // namespace

std::unique_ptr<Path> make_path(const Curve curve, const Vec3 &end)
{
  if (curve == Curve::plane)
    return std::make_unique<Plane>(end);
  return std::make_unique<Cycloid>(end);
}

} // namespace bergamo::driver
