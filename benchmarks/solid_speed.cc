#include "benchmarks/solid_speed.h"

#include "benchmarks/solid_pieces.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace bergamo::benchmark
{
namespace
{

/// What a core shall do at least, million elements of 8 nodes a second.
const std::map<std::string, double> aims{
    {"elastic", 1.5}, {"Mohr-Coulomb elastic", 0.5}, {"Mohr-Coulomb flowing", 1.5}};

std::string name_of(const std::string &name, const int nodes_per_element)
{
  std::ostringstream line;
  line << std::left << std::setw(27) << name << std::right << std::setw(6) << nodes_per_element;
  return line.str();
}

} // namespace

std::string name_of(const SolidCase &what)
{
  return name_of(what.name, what.nodes_per_element());
}

SolidSpeed measure_speed(const SolidCase &what, const int n_along, const int n_repeats, const int n_steps)
{
  MovingSolid solid(what, n_along);
  const double n_elements = solid.body.n_elements(), nodes_per_element = solid.body.n_nodes() / n_elements;
  SolidPieces alone(what, solid);
  alone.time_elements(1); // fetches the copies
  const double to_ns = 1e9 / (n_steps * n_elements);
  std::vector<double> step, strain_and_force, stress, sums, kick, drift;
  for (int repeat = 0; repeat < n_repeats; ++repeat)
  {
    const MovingSolid::Times times = solid.step(n_steps);
    const double elements = alone.time_elements(n_steps), law = alone.time_law(n_steps);
    step.push_back(to_ns * times.whole());
    strain_and_force.push_back(to_ns * std::max(0., elements - law));
    stress.push_back(to_ns * law);
    sums.push_back(to_ns * std::max(0., times.force - elements));
    kick.push_back(to_ns * times.kick);
    drift.push_back(to_ns * times.drift);
  }
  if (!solid.body.is_finite())
    throw std::runtime_error(what.name + ": the motion has diverged, its times mean nothing");
  const double flowing = solid.flowing_share();
  return {what.name,
          what.nodes_per_element(),
          n_elements,
          flowing,
          spread(step),
          {{"strain, force", spread(strain_and_force)},
           {"law", spread(stress)},
           {"sums at nodes", spread(sums)},
           {"kick", spread(kick)},
           {"drift", spread(drift)}},
          operations_of(what, nodes_per_element, flowing),
          memory_of(what, nodes_per_element, flowing)};
}

void print_rates(std::ostream &out, const std::vector<SolidSpeed> &speeds, const CorePeak &peak)
{
  out << "                                                   million elements a second       needed    % of   moved    "
         "% of\n"
         "                            nodes elements flowing   least median   most   aim    GFLOP/s    peak    GB/s    "
         "peak\n"
      << std::fixed;
  for (const SolidSpeed &s : speeds)
  {
    out << name_of(s.name, s.nodes_per_element) << std::setprecision(0) << std::setw(9) << s.n_elements << std::setw(6)
        << 100. * s.flowing_share << " %" << std::setprecision(3) << std::setw(8) << 1e3 / s.step.most << std::setw(7)
        << 1e3 / s.step.median << std::setw(7) << 1e3 / s.step.least << std::setprecision(1) << std::setw(6);
    const auto aim = aims.find(s.name);
    if (aim != aims.end() && s.nodes_per_element == 8)
      out << aim->second;
    else
      out << '-';
    out << std::setw(11) << 1e-9 * s.operation_rate() << std::setw(8) << 100. * s.operation_rate() / peak.operations
        << std::setw(8) << 1e-9 * s.moving_rate() << std::setw(8) << 100. * s.moving_rate() / peak.reading << '\n';
  }
}

void print_parts(std::ostream &out, const std::vector<SolidSpeed> &speeds)
{
  out << "\nns an element (%)           nodes     step" << std::setprecision(0);
  if (!speeds.empty())
    for (const auto &[name, ns] : speeds.front().parts)
      out << std::setw(15) << name;
  out << '\n';
  for (const SolidSpeed &s : speeds)
  {
    out << name_of(s.name, s.nodes_per_element) << std::setw(9) << s.step.median;
    for (const auto &[name, ns] : s.parts)
      out << std::setw(10) << ns.median << " (" << std::setw(2) << 100. * ns.median / s.step.median << ')';
    out << '\n';
  }
}

void print_needs(std::ostream &out, const std::vector<SolidSpeed> &speeds)
{
  out << "\nan element needs                   operations                              bytes\n"
         "                            nodes  strain stress  force motion    all  geometry history forces nodes   all   "
         "moved\n"
      << std::setprecision(0);
  for (const SolidSpeed &s : speeds)
  {
    const auto &[strain, stress, force, motion] = s.operations;
    const ElementMemory &m = s.memory;
    out << name_of(s.name, s.nodes_per_element) << std::setw(8) << strain << std::setw(7) << stress << std::setw(7)
        << force << std::setw(7) << motion << std::setw(7) << s.operations.whole() << std::setw(10) << m.geometry
        << std::setw(8) << m.history << std::setw(7) << m.force << std::setw(6) << m.nodes << std::setw(6) << m.whole()
        << std::setw(8) << m.moved << '\n';
  }
}

nlohmann::json json_of(const Spread &s)
{
  return {{"least", s.least}, {"median", s.median}, {"most", s.most}};
}

nlohmann::json json_of(const SolidSpeed &s)
{
  nlohmann::json parts;
  for (const auto &[name, ns] : s.parts)
    parts[name] = json_of(ns);
  const auto &[strain, stress, force, motion] = s.operations;
  return {{"case", s.name},
          {"nodes_per_element", s.nodes_per_element},
          {"elements", s.n_elements},
          {"flowing_share", s.flowing_share},
          {"elements_per_second", json_of(Spread{1e9 / s.step.most, 1e9 / s.step.median, 1e9 / s.step.least})},
          {"ns_per_element_and_step", json_of(s.step)},
          {"ns_of_parts", parts},
          {"operations", {{"strain", strain}, {"stress", stress}, {"force", force}, {"motion", motion}}},
          {"operations_per_second", s.operation_rate()},
          {"bytes",
           {{"geometry", s.memory.geometry},
            {"history", s.memory.history},
            {"force", s.memory.force},
            {"nodes", s.memory.nodes},
            {"moved_per_step", s.memory.moved}}},
          {"bytes_per_second", s.moving_rate()}};
}

} // namespace bergamo::benchmark
