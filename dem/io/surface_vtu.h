#pragma once

#include "dem/measure/surface_stress.h"
#include "dem/state/surface.h"

#include <filesystem>
#include <span>

namespace bergamo::dem
{

/// Writes surfaces at their present places as one VTU file for ParaView, read_surface() reads it, too: places [m] to
/// the last bit, velocities of the nodes over the step before [m/s]; for each triangle the number of its surface,
/// counted from 0, its pressure, shear stress and traction [Pa], and friction's work [J/m^2]. Open several over time by
/// write_pvd().
///
/// The file appears whole or not at all. Throws ConfigError for stresses of other surfaces, RunError where the file
/// cannot be written.
/// @param stresses of these surfaces, see surface_stress()
void write_surfaces_vtu(std::span<const Surface> surfaces, std::span<const SurfaceStress> stresses,
                        const std::filesystem::path &path);

} // namespace bergamo::dem
