#pragma once

#include "dem/simulation/simulation.h"

#include <cstdint>
#include <span>
#include <vector>

namespace bergamo::driver
{

/// What grains exert on the faces of a body, from the contacts' normal forces and the triangles' present areas.
class ContactPressure
{
public:
  /// @param start the surface where the body is free of stress: its faces that look downwards are put into strips
  /// @param triangles_per_face one face after the other
  /// @param length of the body along x, from `rear` on [m]
  ContactPressure(const dem::Surface &start, std::size_t triangles_per_face, double rear, double length,
                  std::size_t n_strips);

  /// Of the surface at the present step. @param surface its number
  void measure(const dem::Simulation &grains, std::int32_t surface);

  /// Mean over each strip, from the rear to the front [Pa].
  std::span<const double> strips() const { return of_strip; }
  double largest() const { return of_worst_face; } ///< mean over a face, the largest [Pa]

  /// Sum of the lengths of the tangential forces over that of the normal ones: at most Coulomb's coefficient.
  double mobilized_friction() const { return mobilized; }

private:
  std::size_t per_face;
  std::vector<std::size_t> strip_of; // by triangle; n_strips: none
  std::vector<double> of_strip;
  double of_worst_face = 0., mobilized = 0.;
};

} // namespace bergamo::driver
