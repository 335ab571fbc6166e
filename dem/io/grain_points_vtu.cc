#include "dem/io/grain_points_vtu.h"

#include "dem/core/error.h"
#include "dem/geometry/superquadric.h"
#include "dem/io/vtk_cell.h"
#include "dem/io/vtu_writer.h"

#include <cstdint>

namespace bergamo::dem
{

void write_grain_points_vtu(const Particles &particles, const std::span<const GrainField> fields,
                            const std::filesystem::path &path)
{
  check_fields(particles, fields);
  const std::size_t n = particles.size();
  const auto scalar = [n](const std::string &name, auto value)
  {
    return VtuArray{vtu_attributes("Float32", name), n, sizeof(float),
                    [value](const std::size_t i, std::byte *out) { put_bytes(out, static_cast<float>(value(i))); }};
  };
  const auto vectors = [n](const std::string &name, const std::vector<Vec3> &values)
  {
    return VtuArray{vtu_attributes("Float32", name, 3), n, 3 * sizeof(float),
                    [&values](const std::size_t i, std::byte *out) { put_bytes(out, values[i]); }};
  };
  const auto index = [n](const std::string &type, const std::string &name, auto value)
  {
    return VtuArray{vtu_attributes(type, name), n, sizeof(value(n)),
                    [value](const std::size_t i, std::byte *out) { put_bytes(out, value(i)); }};
  };
  std::vector<VtuArray> of_points{
      index("Int64", "id", [&](const std::size_t i) { return particles.id[i]; }),
      scalar("diameter", [&](const std::size_t i) { return 2. * equivalent_radius(particles.volume[i]); }),
      vectors("velocity", particles.velocity)};
  for (const GrainField &field : fields)
    of_points.push_back(scalar(field.name, [values = field.values](const std::size_t i) { return values[i]; }));
  write_vtu({n,
             n,
             vectors("Points", particles.position),
             {index("Int32", "connectivity", [](const std::size_t i) { return static_cast<std::int32_t>(i); }),
              index("Int64", "offsets", [](const std::size_t i) { return static_cast<std::int64_t>(i + 1); }),
              index("UInt8", "types", [](std::size_t) { return vtk_vertex; })},
             of_points,
             {}},
            path);
}

} // namespace bergamo::dem
