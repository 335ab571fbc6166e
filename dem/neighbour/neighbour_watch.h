#pragma once

#include "dem/state/particles.h"
#include "dem/state/surface.h"
#include "dem/state/wall.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::dem
{

/// Tells when lists of candidates have to be renewed: once a particle or a wall may have come half the Verlet distance
/// nearer to others than it was when they were built (Wellmann 3.48). Places are looked at only after the sum of the
/// largest motions allows for it, which costs nothing in between.
///
/// Each particle has a place of its own that the lists count from. Where only some have strayed far from theirs, theirs
/// alone are taken anew, and the lists need only follow for pairs with one of these. Others have at least half of their
/// way before them, so there are about as many renewals as if all were looked at each time.
class NeighbourWatch
{
public:
  double verlet_distance = 0.; ///< range beyond the bounding radii [m]

  /// Takes the present places of all for those of the lists, which are to be renewed as a whole.
  void take_all(const Particles &particles, const std::vector<PlaneWall> &walls, std::span<const Surface> surfaces);

  /// Takes the present places of the particles that have strayed by more than half of what the lists allow for.
  /// @return by part: whether it is one of these, for which the lists are to be renewed
  std::vector<std::uint8_t> take_strayed(const Particles &particles);

  /// Whether the lists may miss a pair by now.
  bool must_renew(const Particles &particles, const std::vector<PlaneWall> &walls, std::span<const Surface> surfaces);

  /// Whether what must be renewed are the whole lists: where walls or surfaces have moved too far, and in periodic
  /// cells, all of whose places change with the edges and whose grains are put back.
  bool must_renew_all(const Particles &particles, const std::vector<PlaneWall> &walls,
                      std::span<const Surface> surfaces) const;

  /// Centres of all parts at the places that the lists count from [m].
  std::vector<Vec3> part_places(const Particles &particles) const;

  /// Where a particle was when the lists were built for it [m]; nothing known of it where it is too new.
  const Vec3 *place_when_built(const std::size_t i) const
  {
    return i < position_when_built.size() ? &position_when_built[i] : nullptr;
  }

  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("verlet_distance", self.verlet_distance);
    visit("look_at_motion", self.look_at_motion);
    visit("position_when_built", self.position_when_built);
    visit("turn_when_built", self.orientation_when_built);
    visit("wall_motion_when_built", self.wall_motion_when_built);
    visit("surface_motion_when_built", self.surface_motion_when_built);
    visit("edges_when_built", self.period_when_built);
  }

private:
  double displacement(const Particles &particles, std::size_t i) const;
  double largest_displacement(const Particles &particles) const;
  bool boundaries_have_moved(const std::vector<PlaneWall> &walls, std::span<const Surface> surfaces) const;

  double look_at_motion = 0.; // Particles::largest_motion below which nothing can have left its neighbours [m]
  std::vector<Vec3> position_when_built;
  std::vector<Quaternion> orientation_when_built; // of clumps, whose parts move when they turn; else empty
  std::vector<double> wall_motion_when_built, surface_motion_when_built;
  Vec3 period_when_built = Vec3::Zero(); // of the periodic cell [m]
};

/// Edges that a periodic cell has at least [m]: two ranges of contacts, the largest distances of the centres of two
/// parts that may be candidates, and twice the largest distance of a part from its particle's centre. Then two parts
/// touch in one image alone, no particle reaches its own image, and a part lies no further outside the cell than
/// build_verlet_list() allows.
double least_cell_edge(const Particles &particles, double verlet_distance);

} // namespace bergamo::dem
