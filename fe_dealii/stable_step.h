#pragma once

#include <cstddef>

namespace bergamo::fe
{

class MovingBody;

struct StableStep
{
  double time_step;          ///< 2/sqrt(largest_eigenvalue) [s]: the leapfrog is stable up to here, or a little beyond
  double largest_eigenvalue; ///< bound on ω² of the body [1/s²]; add that of a penalty before taking the root
  std::size_t element;       ///< the element that sets it
};

/// Stable time step of a body in its elastic state at its present displacement (plastic flow only softens it), with the
/// inertia that mass scaling gave. A stretched state may stiffen: ask again during a run of large strain. No eigenvalue
/// of the body exceeds the largest one of its elements, K_e x = λ M_e x with the lumped element mass (Belytschko, Liu,
/// Moran 2000, sec. 6.2; Wellmann 2.58). Each λ_e is bounded from above, by at most 0.4 %. Prescribed velocities and
/// damping do not lower it. Pressures that follow a surface are not in it. Throws RunError, with place and time, where
/// an element's stiffness is not finite.
StableStep stable_step(const MovingBody &body);

/// Throws RunError, with the stable step and the place of the element that sets it, where a time step [s] exceeds
/// it at the present displacement. To be called before a run and, at large strain, now and then during it.
void require_stable(const MovingBody &body, double time_step);

} // namespace bergamo::fe
