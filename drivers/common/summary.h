#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace bergamo::driver
{

/// The figures that every run reports.
struct RunFigures
{
  double wall_time_s = 0;          ///< of this process, since the last restart
  double core_hours = 0;           ///< of all cores together and over all restarts
  double core_time_per_step_s = 0; ///< the same of a step of the last stage, without what is written and measured
  std::int64_t steps = 0;
  std::int64_t particles = 0;
  std::int64_t threads = 0;
  double particle_steps_per_second = 0;
  double time_step_s = 0;
  double stable_time_step_s = 0;
  double energy_residual = 0;
  std::int64_t undecided_contacts = 0;
  double max_overlap_over_radius = 0;
};

/// The figures of a run by name, in the order in which they were first set.
class Summary
{
public:
  using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

  /// Sets a figure, or changes it in its place. `unit` is for the table; a name in summary.json carries its unit
  /// itself ("wall_time_s").
  template <class Number>
  requires std::is_arithmetic_v<Number>
  void set(const std::string &name, const Number value, const std::string &unit = "")
  {
    if constexpr (std::is_same_v<Number, bool>)
      set_value(name, value, unit);
    else if constexpr (std::is_integral_v<Number>)
      set_value(name, static_cast<std::int64_t>(value), unit);
    else
      set_value(name, static_cast<double>(value), unit);
  }
  void set(const std::string &name, const std::string &text) { set_value(name, text, ""); }
  void set(const std::string &name, const std::vector<double> &values, const std::string &unit = "")
  {
    set_value(name, values, unit);
  }
  void set(const std::string &name, const std::vector<std::string> &texts) { set_value(name, texts, ""); }
  void set(const RunFigures &figures);

  /// The figures as a JSON object in the order set, numbers exact; infinity and NaN become null.
  std::string json() const;

  /// Writes json() atomically. Throws RunError when the file cannot be written.
  void write(const std::filesystem::path &path) const;

  /// A table for the terminal: name, value with six digits, unit; ends with a line break.
  std::string table() const;

private:
  void set_value(const std::string &name, Value value, const std::string &unit);

  struct Figure
  {
    std::string name;
    Value value;
    std::string unit;
  };
  std::vector<Figure> figures;
};

} // namespace bergamo::driver
