#pragma once

#include "dem/state/particles.h"

#include <filesystem>
#include <span>
#include <string>

namespace bergamo::dem
{

/// One figure a grain, shown as a colour under its name.
struct GrainField
{
  std::string name;
  std::span<const double> values; ///< one a grain, in the order of the particles
};

/// Throws ConfigError for a field whose length is not the number of grains.
void check_fields(const Particles &particles, std::span<const GrainField> fields);

/// Writes every grain as its true surface, in its place and orientation, as a VTU file for ParaView.
///
/// The surface is sampled at Barr's angles, `n_per_quarter` steps a quarter turn (even, at least 2), which lie between
/// equal arcs and equal turns of the normal: flat sides get few points, rounded edges many, and the points at 45
/// degrees sit on the edges of box-like grains. The default of 6 makes 288 faces a grain (about 19 kB) and takes at
/// most some 3 % off the volume of common shapes. Each face carries its grain's id, velocity, angular velocity,
/// bounding radius and the given fields.
///
/// Throws ConfigError for a field whose length is not the number of grains, RunError where the file cannot be written.
void write_grains_vtu(const Particles &particles, std::span<const GrainField> fields, const std::filesystem::path &path,
                      int n_per_quarter = 6);

} // namespace bergamo::dem
