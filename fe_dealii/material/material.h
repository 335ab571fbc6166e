#pragma once

#include "fe_dealii/material/hypoplastic.h"
#include "fe_dealii/material/linear_elastic.h"
#include "fe_dealii/material/mohr_coulomb.h"
#include "fe_dealii/material/mooney_rivlin.h"
#include "fe_dealii/material/neo_hooke.h"
#include "fe_dealii/material/ogden.h"

#include <variant>

namespace bergamo::fe
{

/// The law of a solid. The first three are of small strain, the others of large strain and rotation.
using Material = std::variant<LinearElastic, MohrCoulomb, HypoplasticSand, NeoHooke, MooneyRivlin, Ogden>;

inline double density(const Material &material)
{
  return std::visit([](const auto &law) { return law.density(); }, material);
}

/// Speed of compression waves at small strain (of hypoplastic sand, an upper bound at its least pressure), sqrt((K +
/// 4G/3)/ρ) [m/s].
inline double p_wave_speed(const Material &material)
{
  return std::visit([](const auto &law)
                    { return std::sqrt((law.bulk_modulus() + 4 * law.shear_modulus() / 3) / law.density()); },
                    material);
}

/// Speed of shear waves, sqrt(G/ρ) [m/s], as that above.
inline double s_wave_speed(const Material &material)
{
  return std::visit([](const auto &law) { return std::sqrt(law.shear_modulus() / law.density()); }, material);
}

} // namespace bergamo::fe
