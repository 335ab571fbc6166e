#pragma once

#include "drivers/common/parameter_file.h"
#include "fe_dealii/material/material.h"

#include <string>

namespace bergamo::driver
{

enum class ContinuumLaw
{
  mohr_coulomb,
  hypoplastic_sand
};

/// The material of a continuum of soil: a law, and the parameters of each.
struct ContinuumParameters
{
  ContinuumLaw law = ContinuumLaw::mohr_coulomb;
  fe::MohrCoulombParameters mohr_coulomb; ///< its density is that of either law
  fe::HypoplasticParameters sand;

  /// Binds them to a section, "Continuum" or that of another layer: one place for its names, so that what one driver
  /// writes another one reads.
  void declare(ParameterFile &file, const std::string &section = "Continuum");

  /// Throws ConfigError for what the law that is chosen does not allow.
  void validate() const;

  /// Throws ConfigError where a soil at rest has too little pressure for the law. @param pressure the least mean
  /// pressure [Pa]; @param place where that is: the rest of a sentence "the ground has"; @param remedy "raise X"
  void require_pressure(double pressure, const std::string &place, const std::string &remedy) const;

  bool is_sand() const { return law == ContinuumLaw::hypoplastic_sand; }
  double density() const { return mohr_coulomb.density; } ///< of the bulk [kg/m³]
  fe::Material material() const;                          ///< throws ConfigError
};

} // namespace bergamo::driver
