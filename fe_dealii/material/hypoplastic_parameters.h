#pragma once

namespace bergamo::fe
{

/// Parameters of a sand in hypoplasticity. The first eight are von Wolffersdorff's (Mech. Cohes.-Frict. Mater. 1 (1996)
/// 251-271); the defaults are those of Hochstetten sand as they are quoted from Niemunis and Herle (ibid. 2 (1997)
/// 279-299). Herle and Gudehus (ibid. 4 (1999) 461-486) say how to find them, and list sands.
struct HypoplasticParameters
{
  double critical_friction_angle = 33; ///< φ_c [degrees], in (0, 90)
  double granulate_hardness = 1000e6;  ///< h_s [Pa], > 0
  double compression_exponent = 0.25;  ///< n of Bauer's law [-], in (0, 1)
  double densest_void_ratio = 0.55;    ///< e_d0, without pressure [-], > 0
  double critical_void_ratio = 0.95;   ///< e_c0, without pressure [-], > e_d0
  double loosest_void_ratio = 1.05;    ///< e_i0, without pressure [-], >= e_c0
  double pyknotropy_exponent = 0.25;   ///< α: how density raises the peak strength [-], >= 0
  double stiffness_exponent = 1.5;     ///< β: how density raises the stiffness [-], >= 0
  double initial_void_ratio = 0.7;     ///< e at the start [-], between e_d and e_i of the pressure there
  double density = 1600;               ///< of the packing as a whole, at the start [kg/m³], > 0
  double least_pressure = 100;         ///< mean pressure below which the stiffness stays that of it [Pa], > 0

  /// Throws ConfigError that names the first value outside its range.
  void validate() const;

  /// a = √3 (3 − sin φ_c)/(2√2 sin φ_c) [-]: critical stresses have ‖T̂*‖ = F/a.
  double strength_factor() const;
  /// 3 + a² − √3 a ((e_i0 − e_d0)/(e_c0 − e_d0))^α [-]: what the equation makes of the isotropic compression of the
  /// loosest state, whose stiffness is Bauer's.
  double loosest_compression() const;
};

} // namespace bergamo::fe
