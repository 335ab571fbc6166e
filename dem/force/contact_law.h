#pragma once

#include "dem/law/damping.h"
#include "dem/law/hertz.h"
#include "dem/law/mindlin.h"

namespace bergamo::dem
{

/// Constants of every contact of one kind (grain-grain or grain-wall).
struct ContactLaw
{
  ElasticPair elastic;
  double friction = 0.;        ///< Coulomb's coefficient
  double damping_ratio = 0.;   ///< of the dashpot, 1 is critical
  double relaxation_time = 0.; ///< A of the viscoelastic law [s]
};

/// Damping along the normal [N s/m]. @param normal_stiffness d f_el / d delta [N/m]
template <class Real>
Real normal_damping(const ContactLaw &law, const Real &normal_stiffness, const Real &reduced_mass)
{
  return dashpot(law.damping_ratio, normal_stiffness, reduced_mass) +
         viscoelastic(law.relaxation_time, normal_stiffness);
}

/// Energies lost in contacts, and put in by changes of their stiffness [J]. The stiffness follows the curvature at the
/// contact, so the force of rolling non-spherical grains has no potential: what that gives or takes is booked as
/// curvature work.
template <class Real>
struct Losses
{
  Real friction = Real(0.), viscous = Real(0.), curvature = Real(0.);

  template <class Other>
  Losses &operator+=(const Losses<Other> &o)
  {
    if constexpr (std::is_same_v<Real, Other>)
    {
      friction += o.friction;
      viscous += o.viscous;
      curvature += o.curvature;
    }
    else // lanes in their order
      for (int k = 0; k < width<Other>; ++k)
        *this += Losses<Real>{math::lane(o.friction, k), math::lane(o.viscous, k), math::lane(o.curvature, k)};
    return *this;
  }
};
using ContactLosses = Losses<double>;

/// Forces of a touching contact that a step leaves to the next one.
template <class Real>
struct ContactForces
{
  Vector3<Real> tangential; ///< on body 1, without the weight [N]
  Real normal;              ///< f_N >= 0, without the weight [N]

  Vector3<Real> on_body1(const Vector3<Real> &n) const { return tangential - n * normal; }
};

/// Brings the forces of a touching contact to this step. Its losses follow from the trapezoidal rule, which closes the
/// energy balance of the leapfrog scheme.
/// @param normal_stiffness gamma E* [N/m^1.5]; @param tangential over sqrt(overlap), see dem/law/mindlin.h
/// @param root, old_root square roots of this step's overlap, > 0, and of the last one's, 0 for a new contact [m^0.5]
/// @param displacement motion of body 2 relative to body 1 at the contact point since last step [m]
/// @param[in,out] forces last step's, in the present tangent plane; then this step's
/// @param[in,out] losses without the weight [J]
template <class Real, class TangentialStiffness>
void advance_forces(const ContactLaw &law, const Vector3<Real> &normal, const Real &normal_stiffness,
                    const TangentialStiffness &tangential, const Real &reduced_mass, const Real &root,
                    const Real &old_root, const Vector3<Real> &displacement, const double time_step,
                    ContactForces<Real> &forces, Losses<Real> &losses)
{
  const Real approach = -normal.dot(displacement);
  const Vector3<Real> sliding = displacement + normal * approach;
  const Real overlap = root * root, old_overlap = old_root * old_root;

  const Real elastic_force = normal_stiffness * root * overlap;
  const Real damping = normal_damping(law, Real(Real(1.5) * normal_stiffness * root), reduced_mass);
  const Real pushing = elastic_force + damping * approach * Real(1. / time_step);
  const Real normal_force = math::select(pushing <= Real(0.), Real(0.), pushing); // a NaN stays one and stops the run
  const Real old_elastic = Real(0.4) * normal_stiffness * old_root * old_overlap * old_overlap;
  const Real viscous =
      Real(0.5) * (forces.normal + normal_force) * approach - (Real(0.4) * elastic_force * overlap - old_elastic);
  losses.viscous += viscous;

  const TangentialStep<Real> step =
      tangential_step(tangential, root, old_root, forces.tangential, sliding, Real(Real(law.friction) * normal_force));
  losses.friction += step.loss;
  // The last force acts through the loss alone: if it was no number, this one is none, and the grain gets named.
  forces = {step.force, normal_force + Real(0.) * viscous};
}

} // namespace bergamo::dem
