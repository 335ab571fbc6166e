#include "drivers/pile_installation/field_parameters.h"

#include "dem/core/error.h"

#include <algorithm>

namespace bergamo::driver
{

void FieldParameters::declare(ParameterFile &file)
{
  file.add("Fields", "spacing", spacing, "of the spheres in which the solid fraction is sampled, along x and z [m]",
           Range::positive());
  file.add("Fields", "sphere radius", sphere_radius,
           "of these; four mean half-axes of the grains and more for a smooth field [m]", Range::positive());
  file.add("Fields", "stress cell", stress_cell,
           "edge of the cells over which stresses are averaged, along x and z; along y they take all [m]",
           Range::positive());
}

void FieldParameters::validate(const Vec3 &box) const
{
  if (2. * sphere_radius > std::min(box[1], box[2]))
    reject("Fields/sphere radius is ", sphere_radius, " m; choose at most ", 0.5 * std::min(box[1], box[2]),
           " m, half of Sand/box along y and z, so that no sphere reaches out of it");
  if (stress_cell > box[0])
    reject("Fields/stress cell is ", stress_cell, " m; choose at most the length of Sand/box, ", box[0], " m");
  constexpr double most = 1e6;
  for (const auto &[name, edge] : {std::pair("spacing", spacing), std::pair("stress cell", stress_cell)})
    if (box[0] * box[2] > most * edge * edge)
      reject("Fields/", name, " is ", edge, " m: more than a million cells in Sand/box; choose more");
}

} // namespace bergamo::driver
