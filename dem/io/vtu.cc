#include "dem/io/vtu.h"

#include "dem/core/error.h"
#include "dem/io/vtk_cell.h"
#include "dem/io/vtu_writer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <vector>

namespace bergamo::dem
{

namespace
{

/// Points and faces of one part: the poles first and last, rings of longitudes between them from north to south.
struct Globe
{
  int quarter;
  int n_rings, n_longitudes, n_points;
  std::vector<int> connectivity; ///< corners of each face, counter-clockwise from outside
  std::vector<int> face_end;     ///< end of each face in the connectivity
  std::vector<std::uint8_t> face_type;

  explicit Globe(const int n_per_quarter)
      : quarter(n_per_quarter), n_rings(2 * quarter - 1), n_longitudes(4 * quarter),
        n_points(n_rings * n_longitudes + 2)
  {
    const int north = 0, south = n_points - 1;
    for (int j = 0; j < n_longitudes; ++j)
      add_face({north, point(0, j), point(0, j + 1)});
    for (int ring = 0; ring + 1 < n_rings; ++ring)
      for (int j = 0; j < n_longitudes; ++j)
        add_face({point(ring, j), point(ring + 1, j), point(ring + 1, j + 1), point(ring, j + 1)});
    for (int j = 0; j < n_longitudes; ++j)
      add_face({point(n_rings - 1, j), south, point(n_rings - 1, j + 1)});
  }

  int point(const int ring, const int longitude) const { return 1 + ring * n_longitudes + longitude % n_longitudes; }

  void add_face(const std::initializer_list<int> corners)
  {
    connectivity.insert(connectivity.end(), corners);
    face_end.push_back(static_cast<int>(connectivity.size()));
    face_type.push_back(corners.size() == 3 ? vtk_triangle : vtk_quadrilateral);
  }

  /// Surface points of a shape in the body frame. The shape is symmetric to its three planes, so one eighth is
  /// computed; what lies on a plane is put there exactly, for |cos(pi/2)|^eps is far from 0 for a small eps.
  void points(const Superquadric &shape, std::vector<Vec3> &result) const
  {
    const double step = std::numbers::pi / (2. * quarter);
    std::vector<Vec3> eighth((quarter + 1) * (quarter + 1));
    for (int i = 0; i <= quarter; ++i)
      for (int j = 0; j <= quarter; ++j)
      {
        Vec3 &point = eighth[i * (quarter + 1) + j];
        point = surface_point(shape, i * step, j * step);
        if (i == quarter || j == quarter)
          point.x() = 0.;
        if (i == quarter || j == 0)
          point.y() = 0.;
        if (i == 0)
          point.z() = 0.;
      }

    result.resize(n_points);
    result.front() = Vec3(0., 0., shape.half_axes.z());
    result.back() = -result.front();
    for (int ring = 0; ring < n_rings; ++ring)
      for (int longitude = 0; longitude < n_longitudes; ++longitude)
      {
        const int i = quarter - (ring + 1);
        const int sector = longitude / quarter, rest = longitude % quarter;
        const int j = sector % 2 == 0 ? rest : quarter - rest;
        const Vec3 sign(sector == 1 || sector == 2 ? -1. : 1., sector >= 2 ? -1. : 1., i < 0 ? -1. : 1.);
        result[point(ring, longitude)] = sign.cwiseProduct(eighth[std::abs(i) * (quarter + 1) + j]);
      }
  }
};

/// Value of a part, repeated on each of its faces.
template <class Value>
VtuArray face_array(const std::string &attributes, const std::size_t n_parts, const std::size_t bytes,
                    const int n_faces, Value value)
{
  return {attributes, n_parts, n_faces * bytes,
          [n_faces, value](const std::size_t part, std::byte *out)
          {
            for (int face = 0; face < n_faces; ++face)
              put_bytes(out, value(part));
          }};
}

/// Indices that grow by `shift` from one part to the next.
template <class Index>
VtuArray index_array(const std::string &attributes, const std::vector<int> &first, const std::size_t n_parts,
                     const std::size_t shift)
{
  return {attributes, n_parts, first.size() * sizeof(Index),
          [&first, shift](const std::size_t part, std::byte *out)
          {
            for (const int index : first)
              put_bytes(out, static_cast<Index>(part * shift + index));
          }};
}

VtuArray index_array(const std::string &name, const std::vector<int> &first, const std::size_t n_parts,
                     const std::size_t shift)
{
  return n_parts * shift <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())
             ? index_array<std::int32_t>(vtu_attributes("Int32", name), first, n_parts, shift)
             : index_array<std::int64_t>(vtu_attributes("Int64", name), first, n_parts, shift);
}

} // namespace

void check_fields(const Particles &particles, const std::span<const GrainField> fields)
{
  for (const GrainField &field : fields)
    if (field.values.size() != particles.size())
      throw ConfigError("field '" + field.name + "' has " + std::to_string(field.values.size()) + " values for " +
                        std::to_string(particles.size()) + " grains: give one value a grain");
}

void write_grains_vtu(const Particles &particles, const std::span<const GrainField> fields,
                      const std::filesystem::path &path, const int n_per_quarter)
{
  if (n_per_quarter < 2 || n_per_quarter % 2 != 0)
    throw ConfigError("grain surfaces need an even number of steps a quarter turn, at least 2, not " +
                      std::to_string(n_per_quarter));
  check_fields(particles, fields);

  const Globe globe(n_per_quarter);
  const std::size_t n_parts = particles.parts.size();
  const std::size_t n_points = globe.n_points;
  const std::vector<std::int32_t> &carrier = particles.parts.particle;
  const int n_faces = static_cast<int>(globe.face_end.size());

  const VtuArray points{vtu_attributes("Float32", "Points", 3), n_parts, n_points * 3 * sizeof(float),
                        [&](const std::size_t part, std::byte *out)
                        {
                          thread_local std::vector<Vec3> body;
                          globe.points(particles.parts.shape[part], body);
                          const Vec3 centre = particles.part_position(part);
                          const Mat3 turn = particles.part_orientation(part).toRotationMatrix();
                          for (const Vec3 &point : body)
                            put_bytes(out, Vec3(centre + turn * point));
                        }};
  const std::size_t n_corners = globe.connectivity.size();
  const VtuArray types{vtu_attributes("UInt8", "types"), n_parts, globe.face_type.size(),
                       [&](std::size_t, std::byte *out) { std::memcpy(out, globe.face_type.data(), n_faces); }};
  const std::vector<VtuArray> cells{index_array("connectivity", globe.connectivity, n_parts, n_points),
                                    index_array("offsets", globe.face_end, n_parts, n_corners), types};

  const auto vectors = [&](const std::string &name, const std::vector<Vec3> &values)
  {
    return face_array(vtu_attributes("Float32", name, 3), n_parts, 3 * sizeof(float), n_faces,
                      [&carrier, &values](const std::size_t part) -> const Vec3 & { return values[carrier[part]]; });
  };
  const auto scalars = [&](const std::string &name, const std::span<const double> values)
  {
    return face_array(vtu_attributes("Float32", name), n_parts, sizeof(float), n_faces,
                      [&carrier, values](const std::size_t part) { return static_cast<float>(values[carrier[part]]); });
  };
  std::vector<VtuArray> cell_data{face_array(vtu_attributes("Int64", "id"), n_parts, sizeof(std::int64_t), n_faces,
                                             [&](const std::size_t part) { return particles.id[carrier[part]]; }),
                                  vectors("velocity", particles.velocity),
                                  vectors("angular_velocity", particles.angular_velocity),
                                  scalars("bounding_radius", particles.bounding_radius)};
  for (const GrainField &field : fields)
    cell_data.push_back(scalars(field.name, field.values));

  write_vtu({n_parts * n_points, n_parts * n_faces, points, cells, {}, cell_data}, path);
}

} // namespace bergamo::dem
