#include "drivers/common/summary.h"

#include "dem/core/whole_file.h"
#include "drivers/common/number_text.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace bergamo::driver
{

namespace
{

std::string text_of(const bool value)
{
  return value ? "yes" : "no";
}
std::string text_of(const std::int64_t value)
{
  return std::to_string(value);
}
std::string text_of(const double value)
{
  return short_text(value);
}
std::string text_of(const std::string &value)
{
  return value;
}
std::string text_of(const std::vector<double> &values)
{
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : ", ") + short_text(value);
  return text;
}

std::string text_of(const std::vector<std::string> &texts)
{
  std::string text;
  for (const std::string &part : texts)
    text += (text.empty() ? "" : "; ") + part;
  return text;
}

/// Width on a terminal of UTF-8 text: the number of its characters.
std::size_t width(const std::string &text)
{
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](const unsigned char c) { return (c & 0xC0) != 0x80; }));
}

std::string padding(const std::string &text, const std::size_t wanted)
{
  return std::string(wanted - std::min(wanted, width(text)), ' ');
}

bool is_text(const Summary::Value &value)
{
  return std::holds_alternative<std::string>(value) || std::holds_alternative<std::vector<double>>(value) ||
         std::holds_alternative<std::vector<std::string>>(value);
}

} // namespace

void Summary::set(const RunFigures &run)
{
  set("wall_time_s", run.wall_time_s, "s");
  set("core_hours", run.core_hours, "h");
  set("core_time_per_step_s", run.core_time_per_step_s, "s");
  set("steps", run.steps);
  set("particles", run.particles);
  set("threads", run.threads);
  set("particle_steps_per_second", run.particle_steps_per_second, "1/s");
  set("time_step_s", run.time_step_s, "s");
  set("stable_time_step_s", run.stable_time_step_s, "s");
  set("energy_residual", run.energy_residual);
  set("undecided_contacts", run.undecided_contacts);
  set("max_overlap_over_radius", run.max_overlap_over_radius);
}

void Summary::set_value(const std::string &name, Value value, const std::string &unit)
{
  const auto same = std::find_if(figures.begin(), figures.end(), [&](const Figure &f) { return f.name == name; });
  if (same != figures.end())
    *same = {name, std::move(value), unit};
  else
    figures.push_back({name, std::move(value), unit});
}

std::string Summary::json() const
{
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (const Figure &figure : figures)
    std::visit([&](const auto &value) { object[figure.name] = value; }, figure.value);
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void Summary::write(const std::filesystem::path &path) const
{
  write_whole_file(path, json());
}

std::string Summary::table() const
{
  std::size_t name_width = 0, value_width = 0;
  const auto text = [](const Figure &figure)
  { return std::visit([](const auto &value) { return text_of(value); }, figure.value); };
  for (const Figure &figure : figures)
  {
    name_width = std::max(name_width, width(figure.name));
    if (!is_text(figure.value))
      value_width = std::max(value_width, width(text(figure)));
  }
  std::string table;
  for (const Figure &figure : figures)
  {
    const std::string value = text(figure);
    table += "  " + figure.name + padding(figure.name, name_width) + "  ";
    table += is_text(figure.value) ? value : padding(value, value_width) + value;
    table += (figure.unit.empty() ? "" : " " + figure.unit) + "\n";
  }
  return table;
}

} // namespace bergamo::driver
