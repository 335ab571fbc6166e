#include "drivers/common/forecast/forecast_text.h"

#include "drivers/common/number_text.h"
#include "drivers/common/progress.h"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace bergamo::driver
{

namespace
{

std::string padded(const std::string &text, const std::size_t width)
{
  return text + std::string(width - std::min(width, text.size()), ' ');
}

std::string row(const std::string &name, const std::string &text)
{
  return "  " + padded(name, 11) + text + "\n";
}

/// Whole, and of an estimate two digits.
std::string count(const double number, const bool is_exact)
{
  if (is_exact)
    return std::to_string(std::llround(number));
  const double digit = std::pow(10., std::floor(std::log10(std::max(number, 1.))) - 1.);
  return "about " + std::to_string(std::llround(digit < 1. ? number : std::round(number / digit) * digit));
}

std::string sizes(const Forecast &f)
{
  std::string text;
  if (f.n_runs > 1)
    text += row("runs", count(f.n_runs, true) + ", " + count(f.n_side_by_side, true) + " at once");
  if (f.n_grains > 0)
    text += row("grains", count(f.n_grains, f.grains_are_exact) +
                              (f.n_contacts > 0 ? ", in " + count(f.n_contacts, false) + " contacts" : ""));
  if (f.n_elements > 0)
    text += row("elements", count(f.n_elements, true) + " " + f.elements + ", " + count(f.n_nodes, true) + " nodes");
  return text;
}

std::string steps(const Forecast &f)
{
  std::string text;
  bool is_exact = true;
  for (const StageForecast &stage : f.stages)
  {
    is_exact = is_exact && stage.is_exact;
    text += row(text.empty() ? "steps" : "",
                count(stage.n_steps, stage.is_exact) + " of " + short_text(stage.time_step, 3) + " s: " + stage.name +
                    (stage.stable_step > 0 ? " (stable below about " + short_text(stage.stable_step, 3) + " s)" : ""));
  }
  return f.stages.size() > 1 ? text + row("", count(f.n_steps(), is_exact) + " in all") : text;
}

std::string time_text(const double seconds)
{
  constexpr double some = 10; // s, below which a digit behind the point tells something
  return seconds < some ? short_text(seconds, 2) + " s" : format_duration(seconds);
}

std::string left(const double needed, const double available)
{
  if (available <= 0)
    return "";
  return needed > available ? "; WARNING: only " + text_of_bytes(available) + " are free"
                            : "; " + text_of_bytes(available) + " are free";
}

} // namespace

std::string text_of_bytes(const double bytes)
{
  constexpr std::array units = {std::pair(1e12, " TB"), std::pair(1e9, " GB"), std::pair(1e6, " MB")};
  for (const auto &[size, name] : units)
    if (bytes >= 0.9995 * size)
      return short_text(bytes / size, 3) + name;
  return short_text(bytes / 1e3, 3) + " kB";
}

MachineRoom room_for(const std::filesystem::path &folder)
{
  MachineRoom room;
  room.n_threads = omp_get_max_threads();
  std::ifstream memory("/proc/meminfo");
  std::string name;
  for (double kilobytes = 0; memory >> name >> kilobytes; memory.ignore(100, '\n'))
    if (name == "MemAvailable:")
      room.bytes_of_memory = 1024 * kilobytes;
  std::error_code error;
  std::filesystem::path there = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(there, error) && there.has_relative_path())
    there = there.parent_path();
  if (const auto space = std::filesystem::space(there, error); !error)
    room.bytes_of_disk = static_cast<double>(space.available);
  return room;
}

std::string text_of(const Forecast &f, const std::filesystem::path &folder, const MachineRoom &room)
{
  constexpr double program = 160e6; // bytes, with the libraries it loads
  const double memory = program + f.bytes_of_memory, seconds = f.seconds();
  std::string text = sizes(f) + steps(f);
  if (f.n_steps() > 0)
    text += row("time", "about " + time_text(seconds) +
                            ", half to twice as long: by steps tried on this machine "
                            "now, on " +
                            std::to_string(room.n_threads) + (room.n_threads == 1 ? " thread" : " threads"));
  text += row("memory", "about " + text_of_bytes(memory) + left(memory, room.bytes_of_memory));
  text +=
      row("disk", "about " + text_of_bytes(f.bytes()) + " in " + folder.string() + left(f.bytes(), room.bytes_of_disk));
  for (const FileForecast &file : f.files)
    text += row("", padded(text_of_bytes(file.count * file.bytes), 8) + "  " + file.name +
                        (file.count > 1 ? ", " + count(file.count, true) : ""));
  for (const std::string &unknown : f.unknown)
    text += row("not known", unknown);
  return text + "Nothing was computed or written: --dry-run.\n"; // a line of its own, no further unknown
}

} // namespace bergamo::driver
