#include "drivers/common/run/model_pictures.h"

#include "dem/io/contacts_vtu.h"
#include "dem/io/surface_vtu.h"
#include "dem/io/vtu.h"
#include "dem/measure/surface_stress.h"
#include "dem/simulation/simulation.h"
#include "fe_dealii/output.h"

namespace bergamo::driver
{
namespace
{

void write_grains(const dem::Simulation &grains, const std::filesystem::path &path)
{
  std::vector<double> force;
  for (const Vec3 &f : grains.particles.force)
    force.push_back(f.norm());
  const dem::GrainField fields[] = {{"weight", grains.particles.weight}, {"resultant_force", force}};
  dem::write_grains_vtu(grains.particles, fields, path);
}

void write_surfaces(const dem::Simulation &grains, const std::filesystem::path &path)
{
  const std::vector<dem::TouchingContact> contacts = grains.contacts.touching_walls(grains.particles);
  std::size_t n_features = 0;
  for (const dem::Surface &surface : grains.surfaces)
    n_features += surface.n_features();
  const std::vector<double> friction_work = grains.contacts.friction_work(n_features);
  dem::write_surfaces_vtu(grains.surfaces, dem::surface_stress(grains.surfaces, contacts, friction_work), path);
}

void write_contacts(const dem::Simulation &grains, const std::filesystem::path &path)
{
  std::vector<dem::TouchingContact> contacts = grains.contacts.touching(grains.particles);
  const std::vector<dem::TouchingContact> walls = grains.contacts.touching_walls(grains.particles);
  contacts.insert(contacts.end(), walls.begin(), walls.end());
  dem::write_contacts_vtu(grains.particles, contacts, path);
}

} // namespace

Picture picture_of_surfaces(const dem::Simulation &grains)
{
  return {"surfaces", [&grains](const auto &path) { write_surfaces(grains, path); }};
}

Picture picture_of_contacts(const dem::Simulation &grains)
{
  return {"contacts", [&grains](const auto &path) { write_contacts(grains, path); }};
}

std::vector<Picture> pictures_of(const dem::Simulation *grains, const fe::ExplicitBody *body)
{
  std::vector<Picture> pictures;
  if (grains)
    pictures.emplace_back("grains", [grains](const auto &path) { write_grains(*grains, path); });
  if (grains && !grains->surfaces.empty())
    pictures.push_back(picture_of_surfaces(*grains));
  if (body)
    pictures.emplace_back("continuum", [body](const auto &path) { fe::write_vtu(*body, path); });
  return pictures;
}

} // namespace bergamo::driver
