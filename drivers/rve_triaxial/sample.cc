#include "drivers/rve_triaxial/sample.h"

#include "dem/core/error.h"
#include "dem/io/vtu.h"
#include "dem/measure/contact_distributions.h"
#include "dem/measure/contact_list.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/interrupt.h"
#include "drivers/common/packing_target.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/run/step_count.h"
#include "drivers/common/run/visit_models.h"

#include <algorithm>
#include <cmath>

namespace bergamo::driver
{
namespace
{

std::vector<std::string> distribution_columns()
{
  std::vector<std::string> names{"time_s", "stage"};
  for (const auto &[name, value] : dem::contact_distributions({}, 1.))
    names.push_back(name);
  return names;
}

std::vector<double> distribution_row(const dem::Simulation &s, const std::int64_t stage)
{
  std::vector<double> row{s.time, static_cast<double>(stage)};
  for (const auto &[name, value] :
       dem::contact_distributions(s.contacts.touching(s.particles), s.parameters().between_grains().friction))
    row.push_back(value);
  return row;
}

} // namespace

SampleRun::SampleRun(const RveParameters &p, const SampleSettings &s, std::filesystem::path sample_folder,
                     const std::string &parameter_text, Job &shown)
    : parameters(p), settings(s), folder(std::move(sample_folder)), progress(shown), program(p.program(s)),
      snapshot(folder / "snapshot.h5", "sample of a triaxial ensemble", parameter_text),
      loop({p.snapshot_interval, [this] { snapshot.write([this](StateVisitor &v) { visit(v); }); }})
{
}

bool SampleRun::run()
{
  const bool goes_on = std::filesystem::exists(snapshot.path());
  if (goes_on)
    go_on();
  else if (!begin())
    return false;
  const auto opened = [&](const char *name, const std::vector<std::string> &columns)
  { return goes_on ? History::continued(folder / name, columns, loop.last_time()) : History(folder / name, columns); };
  Table table{{{"time_s", [&] { return now.time; }}, {"stage", [&] { return static_cast<double>(stage); }}}};
  table.add(columns_of(now));
  table.add({{"energy_residual_J", [&] { return residual.present(); }}});
  History history = opened("history.csv", table.names());
  History distributions = opened("distributions.csv", distribution_columns());
  const auto n_stages = static_cast<std::int64_t>(program.size());
  progress.particles = static_cast<std::int64_t>(f.n_particles);

  const Stepping stepping{.time = [&] { return simulation->time; },
                          .is_last = [&] { return loading->is_finished(); },
                          .compute = [&] { loading->prepare(*simulation); },
                          .move = [&] { simulation->integrate(); }};
  const auto when = [&](const std::int64_t &next)
  { return either([&](const Moment &) { return simulation->n_steps >= next; }, at_the_end()); };
  const auto add_row = [&]
  {
    measure();
    history.append(table.row());
    dem::check_overlap(now.largest_overlap, now.time, "a smaller time step or a smaller inertial number");
    next_row = simulation->n_steps + steps_to_next_row();
  };
  const auto add_distribution = [&]
  {
    distributions.append(distribution_row(*simulation, stage));
    look_at_step();
    next_distribution = simulation->n_steps + steps_to_next_distribution();
  };
  const auto show = [&]
  { progress.fraction = (stage + loading->progress(*simulation)) / static_cast<double>(n_stages); };
  for (; stage < n_stages; end_stage())
    if (!loop.run(stepping, {{when(next_row), add_row},
                             {when(next_distribution), add_distribution},
                             {every_steps(1), [&] { ++progress.steps_here; }},
                             {every_steps(50), show}}))
      return false;
  f.n_steps = static_cast<double>(simulation->n_steps);
  f.n_undecided = static_cast<double>(simulation->contacts.n_undecided());
  f.wall_time += wall_clock() - clock;
  progress.fraction = 1.;
  return true;
}

void SampleRun::go_on()
{
  try
  {
    snapshot.read([this](StateVisitor &v) { visit(v); });
  }
  catch (const RunError &error)
  {
    throw RunError(std::string(error.what()) + "; or remove it, and --restart begins the sample anew");
  }
}

bool SampleRun::begin()
{
  std::filesystem::create_directories(folder);
  dem::PackingParameters packing;
  packing.solid_fraction = parameters.packing_solid_fraction;
  packing.density = parameters.simulation.grain().density;
  packing.tightening.is_stopped = interrupted;
  const Vec3 edges = Vec3::Constant(settings.edge);
  const auto space = dem::PackingSpace::periodic({Vec3::Zero(), edges});
  dem::PackedGrains packed = parameters.sizes.pack(space, packing, settings.seed);
  if (interrupted())
    return false;
  require_target(packed, packing.solid_fraction, "Packing/solid fraction");
  packed.particles.cell = dem::PeriodicCell(edges);
  dem::SimulationParameters p = parameters.simulation;
  p.between_grains().friction = settings.generation_friction;
  p.time_step = program[0].time_step;
  simulation = std::make_unique<dem::Simulation>(p, std::move(packed.particles), std::vector<dem::PlaneWall>{});
  f.n_particles = static_cast<double>(simulation->particles.size());
  begin_stage();
  return true;
}

void SampleRun::make_loading()
{
  loading.emplace(program.at(stage), dem::mean_grain(simulation->particles), parameters.simulation.grain().density);
}

void SampleRun::begin_stage()
{
  make_loading();
  loading->begin(*simulation);
  next_row = next_distribution = simulation->n_steps;
}

void SampleRun::end_stage()
{
  simulation->integrate();
  const double fraction = dem::solid_fraction(simulation->particles, simulation->particles.cell.volume());
  const std::size_t n_done = static_cast<std::size_t>(stage) + 1;
  if (stage == 0)
    f.generated_solid_fraction = fraction;
  if (n_done + 1 == program.size() || program.size() == 1)
  {
    f.solid_fraction = fraction;
    f.coordination_number = dem::mean_coordination(simulation->contacts, simulation->particles.size());
  }
  if (parameters.pictures)
    dem::write_grains_vtu(simulation->particles, {}, folder / ("grains_000" + std::to_string(stage) + ".vtu"));
  ++stage;
  if (n_done < program.size())
    begin_stage();
}

/// Rows are close to one another where a stage begins to strain, for the stiffness at small strains.
std::int64_t SampleRun::steps_to_next_row() const
{
  const dem::LoadingStage &s = loading->stage();
  if (!s.is_strained())
    return parameters.row_interval;
  const double regular = dem::strain_path(s) / parameters.n_rows, here = std::abs(loading->strain(*simulation)[2]);
  const double spacing = loading->state().leg > 0. ? regular
                         : here < 1e-3             ? std::min(regular, 2e-5)
                         : here < 1e-2             ? std::min(regular, 2e-4)
                                                   : regular;
  return whole_steps(spacing / (loading->rate() * simulation->parameters().time_step));
}

std::int64_t SampleRun::steps_to_next_distribution() const
{
  const dem::LoadingStage &s = loading->stage();
  const double spacing = std::abs(s.axial_strain) / parameters.n_distributions;
  const double step = loading->rate() * simulation->parameters().time_step;
  return s.is_strained() ? whole_steps(std::round(spacing / step)) : 50 * parameters.row_interval;
}

void SampleRun::measure()
{
  now = dem::measure_cell(*simulation, *loading);
  residual.add(now.energy.balance(), now.energy.cell_work);
  const double work = std::abs(now.energy.cell_work);
  const Mat3 &stress = now.assembly.stress;
  f.largest_overlap = std::max(f.largest_overlap, now.largest_overlap);
  if (work > 0.)
    f.energy_residual = std::max(f.energy_residual, std::abs(residual.present()) / std::max(work, now.energy.stored()));
  f.final_solid_fraction = now.solid_fraction;
  f.final_stress_ratio = 2. * stress(2, 2) / (stress(0, 0) + stress(1, 1));
  if (!std::isfinite(f.final_stress_ratio))
    f.final_stress_ratio = 0.;
}

void SampleRun::look_at_step()
{
  const double stable = simulation->stable_time_step(), used = simulation->parameters().time_step;
  if (used / stable < f.time_step / f.stable_step)
    return;
  f.stable_step = stable;
  f.time_step = used;
}

void SampleRun::visit(StateVisitor &visit)
{
  f.wall_time += wall_clock() - std::exchange(clock, wall_clock());
  for (const auto &[name, value] : f.list())
    visit("figures/" + name, *value);
  loop.visit(visit);
  visit("stage", stage);
  visit("next_row", next_row);
  visit("next_distribution", next_distribution);
  residual.visit(visit);
  auto read = visit_grains(visit, simulation.get(), parameters.simulation);
  dem::CellLoading::State state = loading ? loading->state() : dem::CellLoading::State();
  visit("loading", state);
  if (!visit.is_reading())
    return;
  simulation = std::move(read);
  make_loading();
  loading->resume(state);
}

} // namespace bergamo::driver
