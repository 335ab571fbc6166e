#include "drivers/common/forecast/forecast.h"

#include <numeric>

namespace bergamo::driver
{

double Forecast::n_steps() const
{
  return std::accumulate(stages.begin(), stages.end(), 0.,
                         [](const double sum, const StageForecast &stage) { return sum + stage.n_steps; });
}

double Forecast::seconds() const
{
  constexpr double begin_and_end = 0.15; // s: what is set up, the first forces, the last files
  return begin_and_end + std::accumulate(stages.begin(), stages.end(), 0.,
                                         [](const double sum, const StageForecast &stage)
                                         { return sum + stage.n_steps * stage.seconds_per_step; }) /
                             n_side_by_side;
}

double Forecast::bytes() const
{
  return std::accumulate(files.begin(), files.end(), 0.,
                         [](const double sum, const FileForecast &file) { return sum + file.count * file.bytes; });
}

void Forecast::add_own_files(const double snapshot_interval, const double bytes_of_snapshot)
{
  constexpr double bytes_of_texts = 10e3;
  files.push_back({"parameters and summary", 1, bytes_of_texts});
  if (seconds() > snapshot_interval)
    files.push_back({"snapshot", n_side_by_side, bytes_of_snapshot});
}

double bytes_of_row(const double n_columns)
{
  constexpr double bytes_of_number = 19; // to the last bit, and a comma
  return n_columns * bytes_of_number;
}

} // namespace bergamo::driver
