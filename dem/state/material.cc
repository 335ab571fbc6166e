#include "dem/state/material.h"

#include "dem/core/error.h"

#include <cmath>
#include <string>
#include <utility>

namespace bergamo::dem
{

void Material::validate() const
{
  require(young_modulus > 0. && std::isfinite(young_modulus), "Young's modulus", young_modulus, "positive [Pa]");
  require(poisson_ratio >= 0. && poisson_ratio < 0.5, "Poisson's ratio", poisson_ratio, "in [0, 0.5)");
  require(density > 0. && std::isfinite(density), "density", density, "positive [kg/m^3]");
}

void SurfacePair::validate() const
{
  require(friction >= 0. && std::isfinite(friction), "friction coefficient", friction, "at least 0");
  require(damping_ratio >= 0. && std::isfinite(damping_ratio), "damping ratio", damping_ratio, "at least 0");
  require(relaxation_time >= 0. && std::isfinite(relaxation_time), "viscoelastic relaxation time", relaxation_time,
          "at least 0 [s]");
}

MaterialTable::MaterialTable(const std::vector<Material> &all)
{
  for (const Material &material : all)
    add(material);
}

std::int32_t MaterialTable::add(const Material &material)
{
  materials.push_back(material);
  pairs.resize(pair_number(size() - 1, size() - 1) + 1);
  return size() - 1;
}

SurfacePair &MaterialTable::between(const std::int32_t first, const std::int32_t second)
{
  return const_cast<SurfacePair &>(std::as_const(*this).between(first, second));
}

const SurfacePair &MaterialTable::between(const std::int32_t first, const std::int32_t second) const
{
  for (const std::int32_t number : {first, second})
    require(number >= 0 && number < size(), "number of a material", number,
            "that of one of the " + std::to_string(size()) + " materials of the table, counted from 0");
  return pairs[pair_number(first, second)];
}

void MaterialTable::validate() const
{
  require(!materials.empty(), "number of materials", 0., "at least 1");
  for (const Material &material : materials)
    material.validate();
  for (const SurfacePair &pair : pairs)
    pair.validate();
}

} // namespace bergamo::dem
