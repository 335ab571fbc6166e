#pragma once

#include "dem/simulation/simulation.h"
#include "fe_dealii/explicit_body.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::coupling
{

/// The grains outside of an overlap that may come into its elements: where each was when the overlap was made, and how
/// far it may go from there. Those far from the elements may go nearly as far as they are away, so that grains that
/// flow elsewhere do not have the overlap made anew.
class StrayGrains
{
public:
  struct Bounds
  {
    double farthest; ///< motion that counts [m]
    double reach;    ///< of the overlap beside its elements, see make_overlap() [m]
  };

  StrayGrains() = default;

  /// At the present places. @param coupled ids of the grains of the overlap
  StrayGrains(const dem::Particles &particles, std::span<const std::int64_t> coupled, const fe::ExplicitBody &body,
              const Bounds &bounds);

  /// Whether any has gone so far that it may have come into the elements. Looks at the grains only where
  /// Particles::largest_motion lets one have gone that far, so who moves grains by hand adds it there.
  /// @param grains the same ones
  bool may_have_come(const dem::Simulation &grains);

  /// All of it, by name; see dem/core/state.h.
  template <class Self, class Visit>
  static void visit_state(Self &self, Visit &visit)
  {
    visit("id", self.id_);
    visit("place", self.place_);
    visit("reach", self.reach_);
    if constexpr (Visit::is_reading)
      self.look_at_motion_ = 0.;
  }

private:
  std::vector<std::int64_t> id_;
  std::vector<Vec3> place_;   // [m]
  std::vector<double> reach_; // [m]
  // Particles::largest_motion below which none can have come [m]; no part of the state, as a look finds it anew.
  double look_at_motion_ = 0.;
};

} // namespace bergamo::coupling
