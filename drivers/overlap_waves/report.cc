#include "drivers/overlap_waves/report.h"

#include "drivers/common/csv_table.h"

#include <numeric>
#include <span>

namespace bergamo::driver
{

void PulseReport::take_sent(const WaveColumn &column)
{
  sent = column.kinetic_energy();
  sent_work = column.pulse_work() - coupling::energy_of(column.model).viscous_loss;
}

void PulseReport::take_arrived(const WaveColumn &column)
{
  arrived = column.kinetic_energy();
}

void PulseReport::look(const WaveColumn &column)
{
  times.push_back(column.time());
  for (const WaveColumn::Layer &layer : column.layers())
    velocities.push_back(layer.velocity);
}

void PulseReport::add_figures(Summary &summary, const WaveParameters &p) const
{
  const double kinetic = std::accumulate(sent.begin(), sent.end(), 0.);
  const bool is_from_grains = p.source == PulseSource::grains;
  const double reflected = arrived[is_from_grains ? grain_part : continuum_part] / kinetic;
  const double held = arrived[overlap_part] / kinetic;
  const double transmitted = arrived[is_from_grains ? continuum_part : grain_part] / kinetic;
  summary.set("wave_length_m", p.wave_length * p.lattice().spacing, "m");
  summary.set("overlap_from_m", p.part_layers() * p.element_height(), "m");
  summary.set("overlap_m", p.overlap_layers * p.element_height(), "m");
  summary.set("speed_m_s", p.lattice().speed(p.wave), "m/s");
  summary.set("pulse_energy_J", sent_work, "J");
  summary.set("sent_kinetic_share", kinetic / sent_work);
  summary.set("reflected_share", reflected);
  summary.set("held_share", held);
  summary.set("transmitted_share", transmitted);
  summary.set("gained_share", reflected + held + transmitted - 1.);
}

void PulseReport::visit(StateVisitor &visit)
{
  visit("report/sent", std::span<double>(sent));
  visit("report/arrived", std::span<double>(arrived));
  visit("report/sent_work", sent_work);
  visit("report/times", times);
  visit("report/velocities", velocities);
}

void write_waves(const std::filesystem::path &path, const PulseReport &report, const WaveColumn &column)
{
  const std::vector<WaveColumn::Layer> layers = column.layers();
  std::vector<std::vector<double>> rows;
  for (std::size_t look = 0; look < report.times.size(); ++look)
    for (std::size_t k = 0; k < layers.size(); ++k)
      rows.push_back(
          {report.times[look], layers[k].is_continuum, layers[k].place, report.velocities[look * layers.size() + k]});
  write_csv(path, {"time_s", "is_continuum", "place_m", "velocity_m_s"}, rows);
}

} // namespace bergamo::driver
