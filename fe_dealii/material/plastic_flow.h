#pragma once

#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/principal_dyads.h"

namespace bergamo::fe
{

/// What an increment with plastic flow comes to, at one point or at a pack of points.
template <class Real>
struct PlasticFlow
{
  math::Mask<Real> flows; ///< the trial stress lies beyond the yield surface; else all below is the trial's or zero
  Real stress[6];         ///< new stress [Pa]
  Real sector;            ///< a Sector as a number
  Real strain;            ///< equivalent_strain() of the plastic increment [-]
  Real dissipation;       ///< ½(σ_old + σ_new) : Δε_p [J/m³]
};

/// MohrCoulomb::return_to_surface() without branches and eigenvectors, for a pack of points in one go.
/// @param softness inverse of the factor of the moduli in this increment; the new stress is the same for any
/// @param plastic_strain κ before the increment [-]
/// The new stress lies on the surface to rounding of the trial stress. A NaN stays in the stress, where it is seen.
template <class Real>
PlasticFlow<Real> plastic_flow(const MohrCoulomb &law, const Real (&stress_old)[6], const Real (&stress_trial)[6],
                               const Real &softness, const Real &plastic_strain = Real(0.))
{
  const PrincipalDyads<Real> trial = principal_dyads(stress_trial);
  const PrincipalReturn<Real> returned = law.return_principal(trial.value, plastic_strain);
  PlasticFlow<Real> flow;
  flow.flows = returned.yields;
  flow.sector = returned.sector;
  from_dyads(returned.value, trial, flow.stress);
  Real relaxed[6], middle[6];
  for (int i = 0; i < 6; ++i)
  {
    flow.stress[i] = math::select(flow.flows, flow.stress[i], stress_trial[i]);
    relaxed[i] = stress_trial[i] - flow.stress[i];
    middle[i] = 0.5 * (stress_old[i] + flow.stress[i]);
  }
  // Plastic strain is C⁻¹ : relaxed; neither of its two measures needs its components.
  const Real mean = (relaxed[0] + relaxed[1] + relaxed[2]) * (1. / 3.);
  Real normal(0.), shear(0.), square(0.);
  for (int i = 0; i < 3; ++i)
  {
    const Real deviator = relaxed[i] - mean;
    normal += middle[i] * deviator;
    shear += middle[3 + i] * relaxed[3 + i];
    square += 0.5 * deviator * deviator + relaxed[3 + i] * relaxed[3 + i];
  }
  const Real shear_softness = softness * (1 / law.shear_modulus()),
             softness_of_volume = softness * (1 / law.bulk_modulus());
  flow.strain = math::sqrt(Real(square * (1. / 3.))) * shear_softness;
  flow.dissipation = (0.5 * normal + shear) * shear_softness +
                     (middle[0] + middle[1] + middle[2]) * (1. / 3.) * mean * softness_of_volume;
  return flow;
}

} // namespace bergamo::fe
