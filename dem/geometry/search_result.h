#pragma once

#include "dem/geometry/newton_search.h"

namespace bergamo::dem
{

/// What a search found for the pair in lane k.
template <class Real>
ContactGeometry result_of(const NewtonSearch<Real> &search, const int k)
{
  const Evaluation<Real> &e = search.best;
  const double phi = math::lane(e.phi, k);
  const ContactStatus status = phi < 0.                        ? ContactStatus::separated
                               : math::lane(search.is_open, k) ? ContactStatus::undecided
                                                               : ContactStatus::touching;
  return {status,
          math::lane(e.c, k),
          phi,
          math::lane(e.arm1, k),
          math::lane(e.arm2, k),
          lane(e.radii1, k),
          lane(e.radii2, k),
          search.n_evaluations};
}

} // namespace bergamo::dem
