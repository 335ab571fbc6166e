#pragma once

#include "dem/core/types.h"

#include <memory>

namespace bergamo::driver
{

/// Two ways down from one point to another.
enum class Curve
{
  plane,
  cycloid ///< the brachistochrone: that of the shortest time (Bernoulli 1696)
};

/// The way of a sphere's centre from the origin to a lower point, in the plane of x (forwards) and z (upwards), and its
/// motion along it from rest, in closed form. Places go by the share of the travel time that has passed.
class Path
{
public:
  virtual ~Path() = default;

  /// @param share of the travel time, at least 0 @return place [m]
  virtual Vec3 at(double share) const = 0;

  /// From rest at the start to the end. @param gravity that speeds the centre up, see effective_gravity() [m/s²]; [s]
  virtual double travel_time(double gravity) const = 0;

  /// Of a place from the way, towards the side of the sphere positive. @param share where it is nearly [m]
  virtual double distance(const Vec3 &place, double share) const = 0;
};

/// @param end x > 0 and z < 0 [m]
std::unique_ptr<Path> make_path(Curve curve, const Vec3 &end);

} // namespace bergamo::driver
