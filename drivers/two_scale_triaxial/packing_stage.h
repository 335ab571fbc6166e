#pragma once

#include "dem/packing/compression.h"
#include "dem/simulation.h"
#include "drivers/two_scale_triaxial/parameters.h"

#include <memory>

namespace bergamo::driver
{

/// The first stage: grains drawn, placed at random in a box that is wide enough, and compressed between its walls.
struct PackingStage
{
  std::unique_ptr<dem::Simulation> grains;
  dem::Compression compression;
};

/// Draws and places the grains. @throws ConfigError where they do not fit
PackingStage begin_packing(const TriaxialParameters &parameters);

/// What the packing has come to.
struct PackingFigures
{
  double solid_fraction = 0.;
  double coordination_number = 0.; ///< contacts a grain
  dem::Box box;
};

PackingFigures packing_figures(const dem::Simulation &grains);

/// Contacts between grains, counted for both partners, over the number of grains.
double coordination_number(const dem::Simulation &grains);

/// Largest overlap of any contact over the smaller bounding radius of its grains.
double max_overlap_over_radius(const dem::Simulation &grains);

} // namespace bergamo::driver
