#pragma once

#include "dem/io/vtu.h"

namespace bergamo::dem
{

/// Writes every grain as a point at its centre, for assemblies of which the surfaces of write_grains_vtu() would fill
/// the disk: some 50 bytes a grain. ParaView shows them as spheres by Glyph or Point Gaussian, scaled by the diameter
/// of the sphere of equal volume. Each point carries its grain's id, diameter, velocity and the given fields.
///
/// Throws ConfigError for a field whose length is not the number of grains, RunError where the file cannot be written.
void write_grain_points_vtu(const Particles &particles, std::span<const GrainField> fields,
                            const std::filesystem::path &path);

} // namespace bergamo::dem
