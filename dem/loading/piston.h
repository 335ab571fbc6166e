#pragma once

#include "dem/force/touching_contact.h"
#include "dem/state/particles.h"

namespace bergamo::dem
{

/// A wall that is pushed by what a pressure misses and braked by a dashpot which takes up a part of the waves that
/// reach it. It only takes energy out but for the work of the pressure, so it comes to rest with any stiffness, size,
/// density and damping of the grains and with any time step that the contacts bear.
struct Piston
{
  double mass = 0.;      ///< [kg]
  double push = 0.;      ///< towards the grains, that of the pressure less theirs [N]
  double impedance = 0.; ///< of the contacts, see impedance_of() [N s/m]
  double fastest = 0.;   ///< [m/s]

  /// Its speed towards the grains over the drift to come [m/s]. @param speed over the one before [m/s]
  double speed_after(double speed, double time_step) const;
};

/// Heavy beside the grains that touch it, so that no single one throws it back [kg].
double piston_mass(const Particles &grains);

/// A wall that is faster throws the grains about with more than the pressure [m/s].
/// @param pressure [Pa]; @param density of the grains [kg/m^3]
double speed_of_pressure(double pressure, double density);

/// Of a contact: the root of stiffness times mass, with its weight [N s/m].
double impedance_of(const TouchingContact &contact);

} // namespace bergamo::dem
