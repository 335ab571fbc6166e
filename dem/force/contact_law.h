#pragma once

#include "dem/law/damping.h"
#include "dem/law/hertz.h"
#include "dem/law/mindlin.h"

#include <array>

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

/// Energies lost in contacts, or put into them by other than work [J].
template <class Real>
struct Losses
{
  Real friction = Real(0.); ///< lost tangentially: slip, and what a spring lets go of
  Real viscous = Real(0.);  ///< lost in the dashpots
  /// Put in by changes of the stiffness: it follows the curvature at the contact, so the force of rolling non-spherical
  /// grains has no potential.
  Real curvature = Real(0.);
  Real search = Real(0.);     ///< put in by searches, which correct the overlap that was followed
  Real quadrature = Real(0.); ///< put in by time's steps: the trapezoidal work of a normal spring less its energy

  static constexpr auto fields()
  {
    return std::array{&Losses::friction, &Losses::viscous, &Losses::curvature, &Losses::search, &Losses::quadrature};
  }

  template <class Other>
  Losses &operator+=(const Losses<Other> &o)
  {
    if constexpr (std::is_same_v<Real, Other>)
      for (const auto field : fields())
        this->*field += o.*field;
    else // lanes in their order
      for (int k = 0; k < width<Other>; ++k)
        *this += o.of_lane(k);
    return *this;
  }

  Losses<double> of_lane(const int lane) const
  {
    Losses<double> one;
    for (std::size_t f = 0; f < fields().size(); ++f)
      one.*Losses<double>::fields()[f] = math::lane(this->*fields()[f], lane);
    return one;
  }

  Losses operator*(const Real &factor) const
  {
    Losses product = *this;
    for (const auto field : fields())
      product.*field *= factor;
    return product;
  }
};
using ContactLosses = Losses<double>;

/// Losses where the mask is set, else none.
template <class Real>
Losses<Real> losses_where(const math::Mask<Real> &mask, const Losses<Real> &losses)
{
  Losses<Real> some;
  for (const auto field : Losses<Real>::fields())
    some.*field = math::select(mask, losses.*field, Real(0.));
  return some;
}

/// Forces of a touching contact that a step leaves to the next one, without the weight.
template <class Real, class Vector>
struct ContactForces
{
  Vector tangential; ///< on body 1 [N]
  Real normal;       ///< f_N >= 0 [N]
};

/// Motion of body 2 relative to body 1 at a contact since last step, in the frame that turns with the contact.
template <class Real, class Vector>
struct ContactMotion
{
  Real approach;  ///< along the normal, towards one another [m]
  Vector sliding; ///< in the tangent plane [m]
};

/// Hertz's force [N] and energy [J]. @param stiffness gamma E* [N/m^1.5]; @param root of the overlap [m^0.5]
template <class Real>
Real elastic_force(const Real &stiffness, const Real &root)
{
  return stiffness * root * (root * root);
}
template <class Real>
Real elastic_energy(const Real &force, const Real &overlap)
{
  return Real(0.4) * force * overlap;
}

/// Brings the forces of a touching contact to this step. Works follow from the trapezoidal rule, which closes the
/// energy balance of the leapfrog scheme: on the elastic force its error is booked by itself, on the dashpot's it is
/// the loss.
/// @param normal_stiffness gamma E* [N/m^1.5]; @param tangential over sqrt(overlap), see dem/law/mindlin.h
/// @param root, old_root square roots of this step's overlap, > 0, and of the last one's, 0 for a new contact [m^0.5]
/// @param[in,out] forces last step's, turned with the contact; then this step's
/// @param[in,out] losses without the weight [J]
template <class Real, class TangentialStiffness, class Vector = typename TangentialStiffness::Vector>
void advance_forces(const ContactLaw &law, const Real &normal_stiffness, const TangentialStiffness &tangential,
                    const Real &reduced_mass, const Real &root, const Real &old_root,
                    const ContactMotion<Real, Vector> &motion, const double time_step,
                    ContactForces<Real, Vector> &forces, Losses<Real> &losses)
{
  const Real overlap = root * root, old_overlap = old_root * old_root;
  const Real elastic = elastic_force(normal_stiffness, root), old_elastic = elastic_force(normal_stiffness, old_root);
  const Real damping = normal_damping(law, Real(Real(1.5) * normal_stiffness * root), reduced_mass);
  const Real pushing = elastic + damping * motion.approach * Real(1. / time_step);
  const Real normal_force = math::select(pushing <= Real(0.), Real(0.), pushing); // a NaN stays one and stops the run
  const Real half_approach = Real(0.5) * motion.approach;
  const Real viscous = ((forces.normal - old_elastic) + (normal_force - elastic)) * half_approach;
  losses.viscous += viscous;
  losses.quadrature += elastic_energy(elastic, overlap) - elastic_energy(old_elastic, old_overlap) -
                       (elastic + old_elastic) * half_approach;

  const auto step = tangential_step(tangential, root, old_root, forces.tangential, motion.sliding,
                                    Real(Real(law.friction) * normal_force));
  losses.friction += step.loss;
  // The last force acts through the loss alone: if it was no number, this one is none, and the grain gets named.
  forces = {step.force, normal_force + Real(0.) * viscous};
}

} // namespace bergamo::dem
