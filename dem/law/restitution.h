#pragma once

namespace bergamo::dem
{

/// Coefficient of restitution of two bodies that meet head on under the viscoelastic law
///   f = max(k d^(3/2) + (3/2) k A sqrt(d) d', 0),
/// Wellmann (3.30, 3.31) after Brilliantov et al. (1996), by integrating the impact numerically until the force has
/// fallen to zero for good (Schwager & Poeschel 2008). Error below 1e-9.
/// @param relaxation_time A [s], 0 to 1000 (m / (k sqrt(v)))^(2/5), where e is below 1e-5; @param normal_stiffness k =
/// gamma E* [N/m^1.5]
/// @param reduced_mass m1 m2 / (m1 + m2) [kg]; @param speed of approach [m/s]
/// @return in (0, 1]. Throws ConfigError for a value out of range.
double restitution(double relaxation_time, double normal_stiffness, double reduced_mass, double speed);

/// The other way round: A [s] that gives a coefficient of restitution at a speed.
/// @param restitution in [0.01, 1]. Throws ConfigError for a value out of range.
double relaxation_time(double restitution, double normal_stiffness, double reduced_mass, double speed);

/// Coefficient of restitution under the dashpot, Wellmann (3.27-3.29, 3.31): it depends on the damping ratio alone,
/// neither on speed nor on masses and stiffness. Without the bound f >= 0 it would be
/// ratio = sqrt(5/6) |ln e| / sqrt(pi^2 + ln^2 e) (Antypov & Elliott 2011). Error below 1e-9.
/// @param damping_ratio in [0, 10]. Throws ConfigError for a value out of range.
double restitution_of_ratio(double damping_ratio);

/// The other way round. @param restitution in [0.01, 1]. Throws ConfigError for a value out of range.
double damping_ratio_of(double restitution);

} // namespace bergamo::dem
