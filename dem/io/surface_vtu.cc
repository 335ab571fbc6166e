#include "dem/io/surface_vtu.h"

#include "dem/core/error.h"
#include "dem/io/vtk_cell.h"
#include "dem/io/vtu_writer.h"

#include <cstdint>
#include <utility>

namespace bergamo::dem
{
namespace
{

/// Who is who among the nodes or triangles of all surfaces: surface and number.
template <class Count>
std::vector<std::pair<std::int32_t, std::int32_t>> in_a_row(const std::span<const Surface> surfaces, Count count)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> row;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (std::size_t n = 0; n < count(surfaces[s].topology); ++n)
      row.emplace_back(static_cast<std::int32_t>(s), static_cast<std::int32_t>(n));
  return row;
}

void check_stresses(const std::span<const Surface> surfaces, const std::span<const SurfaceStress> stresses)
{
  require(stresses.size() == surfaces.size(), "number of stresses of surfaces", stresses.size(),
          "that of the surfaces, " + std::to_string(surfaces.size()));
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    for (const std::size_t n : {stresses[s].pressure.size(), stresses[s].shear_stress.size(),
                                stresses[s].traction.size(), stresses[s].friction_work.size()})
      require(n == surfaces[s].topology.n_faces(), "number of stresses of surface " + std::to_string(s), n,
              "that of its triangles, " + std::to_string(surfaces[s].topology.n_faces()));
}

} // namespace

void write_surfaces_vtu(const std::span<const Surface> surfaces, const std::span<const SurfaceStress> stresses,
                        const std::filesystem::path &path)
{
  check_stresses(surfaces, stresses);
  const auto nodes = in_a_row(surfaces, [](const SurfaceTopology &t) { return t.n_nodes(); });
  const auto faces = in_a_row(surfaces, [](const SurfaceTopology &t) { return t.n_faces(); });
  std::vector<std::int32_t> first_node{0};
  for (const Surface &surface : surfaces)
    first_node.push_back(first_node.back() + static_cast<std::int32_t>(surface.topology.n_nodes()));

  const VtuArray points{vtu_attributes("Float64", "Points", 3), nodes.size(), 3 * sizeof(double),
                        [&](const std::size_t n, std::byte *out)
                        { put_bytes<double>(out, surfaces[nodes[n].first].node[nodes[n].second]); }};
  const VtuArray velocity{vtu_attributes("Float32", "velocity", 3), nodes.size(), 3 * sizeof(float),
                          [&](const std::size_t n, std::byte *out)
                          {
                            const Surface &surface = surfaces[nodes[n].first];
                            put_bytes<float>(out, surface.is_at_rest() ? Vec3(Vec3::Zero())
                                                                       : surface.drift_velocity[nodes[n].second]);
                          }};
  const auto of_faces = [&](const std::string &attributes, const std::size_t bytes, auto put)
  {
    return VtuArray{attributes, faces.size(), bytes,
                    [&faces, put](const std::size_t f, std::byte *out) { put(faces[f].first, faces[f].second, out); }};
  };
  const VtuArray connectivity = of_faces(vtu_attributes("Int32", "connectivity"), 3 * sizeof(std::int32_t),
                                         [&](const std::int32_t s, const std::int32_t t, std::byte *out)
                                         {
                                           for (const std::int32_t node : surfaces[s].topology.triangle[t])
                                             put_bytes(out, first_node[s] + node);
                                         });
  const VtuArray offsets{vtu_attributes("Int64", "offsets"), faces.size(), sizeof(std::int64_t),
                         [](const std::size_t f, std::byte *out)
                         { put_bytes(out, static_cast<std::int64_t>(3 * (f + 1))); }};
  const VtuArray types{vtu_attributes("UInt8", "types"), faces.size(), sizeof vtk_triangle,
                       [](std::size_t, std::byte *out) { put_bytes(out, vtk_triangle); }};
  const VtuArray number = of_faces(vtu_attributes("Int32", "surface"), sizeof(std::int32_t),
                                   [](const std::int32_t s, std::int32_t, std::byte *out) { put_bytes(out, s); });
  const auto scalar = [&](const std::string &name, std::vector<double> SurfaceStress::*values)
  {
    return of_faces(vtu_attributes("Float32", name), sizeof(float),
                    [stresses, values](const std::int32_t s, const std::int32_t t, std::byte *out)
                    { put_bytes(out, static_cast<float>((stresses[s].*values)[t])); });
  };
  const VtuArray traction = of_faces(vtu_attributes("Float32", "traction", 3), 3 * sizeof(float),
                                     [&](const std::int32_t s, const std::int32_t t, std::byte *out)
                                     { put_bytes<float>(out, stresses[s].traction[t]); });
  write_vtu(
      {nodes.size(),
       faces.size(),
       points,
       {connectivity, offsets, types},
       {velocity},
       {number, scalar("pressure", &SurfaceStress::pressure), scalar("shear_stress", &SurfaceStress::shear_stress),
        traction, scalar("friction_work", &SurfaceStress::friction_work)}},
      path);
}

} // namespace bergamo::dem
