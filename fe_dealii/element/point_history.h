#pragma once

#include "fe_dealii/element/points.h"
#include "fe_dealii/material/hypoplastic_integration.h"
#include "fe_dealii/material/mohr_coulomb.h"

/// What the points of elements of small strain remember, law by law.
namespace bergamo::fe
{

/// What eight points remember.
struct PointHistory
{
  Points stress[6];         ///< xx yy zz xy yz zx [Pa]
  Points plastic_strain;    ///< sum of equivalent_strain() of the plastic increments, and what the start mobilises [-]
  Points dissipated_energy; ///< accumulated plastic dissipation, share included [J]
  Points stiffness_loss;    ///< elastic work less what is stored, share included, where the stiffness varies [J]
};

/// What eight points of hypoplastic sand remember. The law knows no elastic part: plastic_strain is that of the whole
/// strain, and dissipated_energy all work of the stresses, which gives back what unloading gives back.
struct SandHistory : PointHistory
{
  Points void_ratio; ///< e [-]
};

/// What a law keeps at the points: a history, and a report of the last increment that no restart needs.
template <class Law>
struct KeptAtPoints
{
  using History = PointHistory;
  using Report = Sector;
};
template <>
struct KeptAtPoints<HypoplasticSand>
{
  using History = SandHistory;
  using Report = SandUpdateStatus;
};

} // namespace bergamo::fe
