#pragma once

#include "dem/simulation/simulation_parameters.h"
#include "fe_dealii/material/elastic_parameters.h"

namespace bergamo::driver
{

/// Which way the particles of a plane wave go.
enum class Wave
{
  compression, ///< along its way
  shear        ///< across it
};

/// Equal spheres in a simple cubic lattice that bears an isotropic pressure, for waves along one of its axes: small
/// beside the overlaps of the contacts, whose stiffness then is that of the pressure. Each contact has a normal and a
/// tangential spring (Hertz, Mindlin).
///
/// A compression moves whole layers, and their contacts are a chain of springs: m w^2 = 4 k_n sin^2(q d / 2). In a
/// shear the spheres turn, too: with s = sin(q d / 2), w^2 = (k_t / m) W,
///   j W^2 - (4 j s^2 + 2 - s^2) W + 4 s^2 = 0,   j = I / (m d^2),
/// whose lower root is the wave; the layers' contacts along and across the motion resist the turn. Both are the
/// eigenvalues of the lattice's equations of motion for displacements u exp(i q z) and turns t exp(i q z); a micropolar
/// lattice (Suiker, Metrikine & de Borst, Int. J. Solids Struct. 38 (2001) 1563-1583).
struct CubicLattice
{
  double spacing = 0., overlap = 0.;   ///< d, of the centres, and of a contact [m]
  double normal = 0., tangential = 0.; ///< k_n, k_t of a contact [N/m]
  double mass = 0., inertia = 0.;      ///< m, I of a sphere [kg], [kg m^2]

  /// Of long waves [Pa]: k_n / d, and k_t / (2 d), as half of a shear turns the spheres.
  double modulus(const Wave wave) const
  {
    return wave == Wave::compression ? normal / spacing : 0.5 * tangential / spacing;
  }
  double density() const { return mass / (spacing * spacing * spacing); } ///< of the space with its voids [kg/m^3]
  double speed(Wave wave) const;                                          ///< of long waves [m/s]

  double frequency(Wave wave, double wave_number) const;      ///< w [1/s] @param wave_number q in [0, pi / d] [1/m]
  double group_velocity(Wave wave, double wave_number) const; ///< dw/dq [m/s]

  /// The isotropic solid of the same density and of the same two moduli. Its Poisson's ratio is positive where k_t <
  /// k_n.
  fe::ElasticParameters continuum() const;
};

/// The lattice under a pressure [Pa], > 0. @param radius of the spheres [m]
CubicLattice press_lattice(double radius, const dem::Material &material, double pressure);

} // namespace bergamo::driver
