#include "drivers/two_scale_triaxial/specimen_sample.h"

#include "drivers/common/csv_table.h"

#include <string>

namespace bergamo::driver
{

void SpecimenSample::add_figures(Summary &summary) const
{
  for (int d = 0; d < 3; ++d)
    summary.set("stress_" + std::to_string(d + 1) + "_Pa", stress[d], "Pa");
  summary.set("coupling_difference_m", coupling_difference, "m");
  summary.set("stress_3_unevenness", coupling::unevenness(profile));
}

void write_profile(const std::filesystem::path &path, const std::vector<coupling::SlabStress> &profile)
{
  std::vector<std::string> names{"low_m", "high_m"};
  for (const std::string model : {"grains", "continuum"})
    for (const std::string component : {"1", "2", "3"})
      names.push_back(model + "_stress_" + component + "_Pa");
  std::vector<std::vector<double>> rows;
  for (const coupling::SlabStress &slab : profile)
  {
    const Vec3 &g = slab.grains, &c = slab.continuum;
    rows.push_back({slab.low, slab.high, g[0], g[1], g[2], c[0], c[1], c[2]});
  }
  write_csv(path, names, rows);
}

} // namespace bergamo::driver
