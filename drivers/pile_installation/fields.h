#pragma once

#include "dem/measure/hexahedron_grid.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/pile_installation/installation.h"

#include <filesystem>
#include <span>
#include <vector>

namespace bergamo::driver
{

/// Where all ground is grains: |x| below its half width, z above its bottom [m].
struct GrainDomain
{
  double half_width, bottom;
};

/// Solid fraction in spheres about the centres of a grid's cells, each grain as a sphere of equal volume. Not a number
/// where a sphere reaches beyond the domain of the grains. Too low at the surface and beside the pile, where it reaches
/// out of the sand. @param radius of the spheres [m]
std::vector<double> solid_fractions(std::span<const dem::Sphere> grains, const dem::HexahedronGrid &grid,
                                    const GrainDomain &domain, double radius);

/// @name The grids of a run, the same at all times and for ground of both kinds
/// One layer of cells along y, as deep as the ground, and upwards to the settled sand's highest point and a pile's
/// width above.
/// @{
dem::HexahedronGrid solid_fraction_grid(const InstallationParameters &p, const InstallationStart &start);
dem::HexahedronGrid stress_grid(const InstallationParameters &p, const InstallationStart &start);
/// @}

/// @name Files for ParaView, cell data on these grids, of the present step once its forces are known
/// Whole or not at all. Throw RunError where one cannot be written.
/// @{

/// "solid_fraction", see solid_fractions().
void write_solid_fraction(const Installation &installation, const InstallationParameters &p,
                          const std::filesystem::path &path);

/// Means of what grains and continuum bear together, each with its weight [Pa]: "pressure", "deviatoric_stress"
/// (sqrt(3/2 s:s)), "stress_xx", "stress_yy", "stress_zz", "stress_zx" (tension positive), and the parts of both in the
/// pressure, "pressure_of_grains", "pressure_of_continuum".
void write_stress(const Installation &installation, const InstallationParameters &p, const std::filesystem::path &path);
/// @}

} // namespace bergamo::driver
