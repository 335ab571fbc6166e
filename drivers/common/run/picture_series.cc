#include "drivers/common/run/picture_series.h"

#include "dem/io/pvd.h"

#include <cstdio>
#include <utility>

namespace bergamo::driver
{

PictureSeries::PictureSeries(std::filesystem::path f, std::string n) : folder(std::move(f)), name(std::move(n)) {}

std::string PictureSeries::file_name(const std::size_t number) const
{
  char digits[32];
  std::snprintf(digits, sizeof digits, "_%04zu.vtu", number);
  return name + digits;
}

void PictureSeries::add(const double time, const std::function<void(const std::filesystem::path &)> &write)
{
  times.push_back(time);
  write(folder / file_name(times.size() - 1));
  std::vector<std::pair<double, std::string>> frames;
  for (std::size_t k = 0; k < times.size(); ++k)
    frames.emplace_back(times[k], file_name(k));
  dem::write_pvd(folder / (name + ".pvd"), frames);
}

} // namespace bergamo::driver
