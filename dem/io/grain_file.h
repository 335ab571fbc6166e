#pragma once

#include "dem/geometry/clump.h"
#include "dem/packing/space.h"
#include "dem/state/material.h"
#include "dem/state/particles.h"

#include <filesystem>
#include <map>
#include <string>

namespace bergamo::dem
{

/// Grains that a file holds.
struct GrainsOfFile
{
  Particles particles;   ///< at rest, in the order of the file
  Box box;               ///< about the spheres that bound the grains [m]
  std::string statement; ///< of one line: how many grains of what sizes and materials lie where
};

/// Reads grains from a table with commas (.csv) or a dump of one time step of LAMMPS or LIGGGHTS (any other name); see
/// GrainColumns for the names of the columns, others are left out. Lines of a table that follow one another with the
/// same id are the parts of a clump; clumps that are alike up to their size, to 1e-6, are copies of the first of them.
/// Of plain grains places, half-axes and exponents are taken to the last digit; ids too, where they are 0 to n - 1 in
/// any order, otherwise grains are counted in the order of the file.
/// @param materials whose densities the grains have; @param unit of the file's lengths [m]
/// Throws ConfigError, with file, line and column, for what cannot be read, has no meaning, or names a grain twice.
GrainsOfFile read_grains(const std::filesystem::path &path, const MaterialTable &materials, double unit = 1.);

/// Reads clumps by their names, as they stand in the file's frame: a table with commas with the columns of
/// read_grains(), and clump, a name, instead of id. Lines of one name follow one another.
/// @param unit of the file's lengths [m]. Throws ConfigError likewise.
std::map<std::string, ClumpShape> read_clumps(const std::filesystem::path &path, double unit = 1.);

} // namespace bergamo::dem
