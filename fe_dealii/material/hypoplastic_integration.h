#pragma once

#include "fe_dealii/material/hypoplastic.h"

#include <string>

namespace bergamo::fe
{

/// How an increment of strain is parted.
struct SubstepControl
{
  double tolerance = 1e-6;     ///< error of a substep's stress over the stress [-], > 0
  double least_substep = 1e-5; ///< share of the increment below which no substep is tried [-], in (0, 1]
};

enum class SandUpdateStatus
{
  done,
  substep_too_small, ///< the error cannot be kept, or a value is not finite
  no_voids           ///< the strain leaves no volume between the grains
};

struct SandUpdate
{
  SandState state;         ///< after the increment; before it unless done
  SandUpdateStatus status; ///< numerics that failed are a status, which the caller reports
  int n_substeps;          ///< accepted
  int n_rejected;
};

/// Carries a sand over an increment of strain of any size, at a constant direction of D. Explicit: the pair of
/// Runge-Kutta methods of orders 3 and 2 by Bogacki and Shampine (Appl. Math. Lett. 2 (1989) 321-325), advanced with
/// order 3, substeps chosen as Sloan (Int. J. Numer. Methods Eng. 24 (1987) 893-911) does for plasticity. The error is
/// that of order 2, over the stress or that of least_pressure, whichever is greater. The void ratio is exact:
/// 1 + e = (1 + e_old) exp(tr Δε). Principal stresses above zero are cut off after every substep.
SandUpdate update(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                  const SubstepControl &control = {});

/// Derivative of the stress after update() by the increment: that of the substeps which update() takes, by differences
/// of the substeps' own increments (Fellin and Ostermann, Int. J. Numer. Anal. Meth. Geomech. 26 (2002) 1213-1233). It
/// is the one by which Newton's method converges for increments of any size; for small ones it is
/// HypoplasticResponse::tangent() at the start. Where the increment is zero there is no derivative, and this is the
/// linear part of the response; where update() fails, the tangent at the start. Allocates.
Moduli consistent_tangent(const HypoplasticSand &sand, const SandState &start, const Strain &increment,
                          const SubstepControl &control = {});

/// What a failed update means and what helps: the rest of a sentence "element E has". @param state before it
std::string explain(SandUpdateStatus status, const SandState &state);

} // namespace bergamo::fe
