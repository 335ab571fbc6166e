#include "drivers/common/run/picture_series.h"

#include "dem/core/pvd.h"

#include <cstdio>

namespace bergamo::driver
{
namespace
{

std::string file_name(const std::string &model, const std::size_t number)
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "_%04zu.vtu", number);
  return model + digits;
}

} // namespace

void PictureSeries::add(const double time, const std::vector<Picture> &models)
{
  times.push_back(time);
  for (const auto &[name, write] : models)
  {
    std::vector<std::pair<double, std::string>> frames;
    for (std::size_t k = 0; k < times.size(); ++k)
      frames.emplace_back(times[k], file_name(name, k));
    write(folder / frames.back().second);
    write_pvd(folder / (name + ".pvd"), frames);
  }
}

} // namespace bergamo::driver
