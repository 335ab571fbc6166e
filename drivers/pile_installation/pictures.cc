#include "drivers/pile_installation/pictures.h"

#include "dem/io/vtu.h"
#include "dem/measure/grain_pressure.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/pile_installation/fields.h"
#include "fe_dealii/output.h"

namespace bergamo::driver
{
namespace
{

void write_grains(const Installation &installation, const std::filesystem::path &path)
{
  const dem::Simulation &sand = installation.sand();
  const dem::Particles &grains = sand.particles;
  const std::vector<double> pressure =
      dem::grain_pressures(grains, sand.contacts.touching(grains), sand.contacts.touching_walls(grains));
  std::vector<double> displacement, sinking, initial_height;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    const Vec3 &before = installation.start().place_by_id[grains.id[i]];
    displacement.push_back((grains.position[i] - before).norm());
    sinking.push_back(before[2] - grains.position[i][2]);
    initial_height.push_back(before[2]);
  }
  const dem::GrainField fields[] = {{"weight", grains.weight},
                                    {"pressure", pressure},
                                    {"displacement", displacement},
                                    {"sinking", sinking},
                                    {"initial_height", initial_height}};
  constexpr int coarse = 4; // steps a quarter turn
  dem::write_grains_vtu(grains, fields, path, coarse);
}

} // namespace

std::vector<Picture> pictures_of(const Installation &installation, const InstallationParameters &p)
{
  std::vector<Picture> pictures{
      {"grains", [&installation](const auto &path) { write_grains(installation, path); }},
      picture_of_surfaces(installation.sand()),
      picture_of_contacts(installation.sand()),
      {"solid_fraction", [&](const auto &path) { write_solid_fraction(installation, p, path); }},
      {"stress", [&](const auto &path) { write_stress(installation, p, path); }}};
  if (const fe::ExplicitBody *body = installation.body())
    pictures.emplace_back("continuum", [body](const auto &path) { fe::write_vtu(*body, path); });
  return pictures;
}

} // namespace bergamo::driver
