#include "drivers/penetration/pictures.h"

#include "dem/io/vtu.h"
#include "dem/measure/grain_pressure.h"
#include "drivers/common/run/model_pictures.h"

namespace bergamo::driver
{
namespace
{

void write_grains(const Intrusion &intrusion, const std::filesystem::path &path)
{
  const dem::Simulation &sand = intrusion.sand();
  const dem::Particles &grains = sand.particles;
  const std::vector<double> pressure =
      dem::grain_pressures(grains, sand.contacts.touching(grains), sand.contacts.touching_walls(grains));
  std::vector<double> sinking;
  for (std::size_t i = 0; i < grains.size(); ++i)
    sinking.push_back(intrusion.start_place(grains.id[i])[2] - grains.position[i][2]);
  const dem::GrainField fields[] = {{"pressure", pressure}, {"sinking", sinking}};
  constexpr int coarse = 4; // steps a quarter turn
  dem::write_grains_vtu(grains, fields, path, coarse);
}

} // namespace

std::vector<Picture> pictures_of(const Intrusion &intrusion)
{
  return {{"grains", [&intrusion](const auto &path) { write_grains(intrusion, path); }},
          picture_of_surfaces(intrusion.sand()),
          picture_of_contacts(intrusion.sand())};
}

} // namespace bergamo::driver
