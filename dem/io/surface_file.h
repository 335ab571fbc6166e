#pragma once

#include "dem/state/surface.h"

#include <filesystem>

namespace bergamo::dem
{

/// What a surface from a file is to be.
enum class SurfaceUse
{
  sheet,  ///< open or closed, grains on the side of its normals
  body,   ///< closed, grains outside, normals outwards
  vessel, ///< closed, grains inside, normals inwards
};

struct SurfaceFileParameters
{
  double unit = 1.;  ///< of the file's places [m]: 0.001 for millimetres
  bool flip = false; ///< grains are on the other side than the file's normals point to
  SurfaceUse use = SurfaceUse::sheet;
  double merge_tolerance = 1e-6; ///< nodes that are nearer become one [longest side of the surface], in [1e-12, 1e-2]
};

/// Reads a surface of triangles, at rest: STL (.stl, text or binary), a mesh of Gmsh (.msh) or an unstructured grid of
/// VTK (.vtu, as ParaView and meshio write it). Quadrilaterals are cut in two. Triangles keep the order of the file, in
/// which messages count them from 0. STL repeats each node in each triangle: nodes in the same place become one.
/// Throws ConfigError, with the file's name, for parameters out of range; a file that is missing, empty, truncated, of
/// another format or with cells that are no triangles; a triangle without an area; triangles that make no surface, as
/// SurfaceTopology says it; and, where the use asks for a closed surface, holes and normals that point to the wrong
/// side (of the volume as a whole: of several bodies in one file each is not looked at).
Surface read_surface(const std::filesystem::path &path, const SurfaceFileParameters &parameters = {});

} // namespace bergamo::dem
