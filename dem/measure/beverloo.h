#pragma once

#include <span>

namespace bergamo::dem
{

/// What Beverloo's law scales a flow out of an orifice with.
struct BeverlooScale
{
  double bulk_density; ///< [kg/m^3]
  double gravity;      ///< [m/s^2]
  double diameter;     ///< of the grains [m]
  double slot_length;  ///< of a slot, between walls that the grains touch [m]; 0 for a circular orifice
};

/// Beverloo's law (Beverloo, Leniger, van de Velde 1961; of slots: Nedderman 1992): the mass flow is
/// C rho g^1/2 (D - k d)^5/2 out of a circle of diameter D, C rho g^1/2 L (W - k d)^3/2 out of a slot of width W whose
/// ends are walls. Usual values: C from 0.55 to 0.65 for circles, about 1.03 for slots; k from 1.2 to 3, 1.4 for
/// spheres.
struct BeverlooLaw
{
  double c = 0., k = 0.;

  /// @param width of the orifice [m] @return [kg/s]; 0 where it is no wider than k d
  double flow(double width, const BeverlooScale &scale) const;
};

/// C and k of the law through measured flows: the 2/5th or 2/3rd power of the flow is a straight line over the width,
/// whose least squares they are. @param widths [m], at least two that differ; @param flows of each, > 0 [kg/s] Throws
/// ConfigError for other numbers, or flows that do not grow with the width.
BeverlooLaw fit_beverloo(std::span<const double> widths, std::span<const double> flows, const BeverlooScale &scale);

} // namespace bergamo::dem
