#pragma once

#include "dem/core/types.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>

namespace bergamo::dem
{

/// One of the 27 images of a grain in a periodic cell and its neighbours: n1 + 3 n2 + 9 n3 + 13 for a shift by n_i L_i,
/// n_i in {-1, 0, 1} (Wellmann 5.2).
using Image = std::int8_t;
constexpr int n_images = 27;
constexpr Image own_image = 13; ///< no shift

constexpr Image opposite(const Image image)
{
  return static_cast<Image>(n_images - 1 - image);
}

/// Shift of an image in edges of the cell.
inline Vec3 shift_of(const Image image)
{
  return Vec3(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
}

/// Rectangular cell from the origin to `edges` that repeats itself in all directions (Wellmann 5.1), or in those alone
/// in which its edge is finite. Grains outside are put back when the neighbours are renewed. A grain's image has the
/// grain's velocity plus n_i dL_i/dt; a change of dL/dt goes to all grains in proportion to their place, so that no
/// place and no face of the cell is special.
struct PeriodicCell
{
  /// Nothing repeats itself.
  PeriodicCell();

  /// @param edges lengths L [m], > 0; infinite in directions in which nothing repeats itself
  explicit PeriodicCell(const Vec3 &edges);

  /// In a direction, in any, in all. @{
  bool is_periodic(const int direction) const { return edges[direction] < std::numeric_limits<double>::infinity(); }
  bool is_periodic() const { return is_periodic(0) || is_periodic(1) || is_periodic(2); }
  bool is_closed() const { return is_periodic(0) && is_periodic(1) && is_periodic(2); }
  /// @}
  double volume() const { return edges.prod(); } ///< of a closed one; else infinite [m^3]

  /// "x", "x and y", "x, y and z": the directions in which it repeats itself.
  std::string directions() const;

  /// The image of a grain that is nearest to another. @param line from the other grain to this one [m]
  Image nearest_image(const Vec3 &line) const;

  /// Goes on to the next step. @param kick from the last half step to the next one [s]; @param drift time step [s]
  void advance(double kick, double drift);

  /// Throws ConfigError for edges that are not positive, or for a rate of one that is infinite.
  void validate() const;

  /// Throws ConfigError where it does not repeat itself in all directions. @param what needs it, as a subject
  void require_closed(const char *what) const;

  /// Follows edges and rate.
  void update_images();

  Vec3 edges;                       ///< L at this step; infinite: not periodic there [m]
  Vec3 period;                      ///< the same with 0 for what is infinite, to be multiplied by any number [m]
  Vec3 rate = Vec3::Zero();         ///< dL/dt at the half step before [m/s]
  Vec3 drift_rate = Vec3::Zero();   ///< dL/dt over the step before, which led to the present edges [m/s]
  Vec3 acceleration = Vec3::Zero(); ///< d2L/dt2 at this step, to be set by who controls the cell [m/s^2]
  double motion = 0.;               ///< path that bounds the motion of images against one another since the start [m]

  /// Of the images against the grain itself: their places, and the velocities that led there [m, m/s].
  std::array<Vec3, n_images> place, velocity;

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("edges", self.edges);
    visit("rate", self.rate);
    visit("drift_rate", self.drift_rate);
    visit("acceleration", self.acceleration);
    visit("motion", self.motion);
    if constexpr (Visit::is_reading)
      self.update_images();
  }
};

} // namespace bergamo::dem
