#include "drivers/rve_triaxial/sample.h"

#include "dem/core/error.h"
#include "dem/core/pvd.h"
#include "dem/io/snapshot.h"
#include "dem/io/vtu.h"
#include "dem/measure/assembly_measures.h"
#include "dem/measure/contact_list.h"
#include "dem/measure/solid_fraction.h"
#include "drivers/common/interrupt.h"
#include "drivers/rve_triaxial/distributions.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace bergamo::driver
{
namespace
{

constexpr const char *snapshot_kind = "sample of a triaxial ensemble";

/// HDF5 serves one thread at a time.
std::mutex archives;

const std::vector<std::string> columns = {"time_s",
                                          "stage",
                                          "strain_x",
                                          "strain_y",
                                          "strain_z",
                                          "volumetric_strain",
                                          "stress_xx_Pa",
                                          "stress_yy_Pa",
                                          "stress_zz_Pa",
                                          "stress_xy_Pa",
                                          "stress_xz_Pa",
                                          "stress_yz_Pa",
                                          "solid_fraction",
                                          "inertial_number",
                                          "n_contacts",
                                          "coordination_number",
                                          "mechanical_coordination_number",
                                          "coordination_number_without_rattlers",
                                          "rattler_fraction",
                                          "fabric_xx",
                                          "fabric_yy",
                                          "fabric_zz",
                                          "fabric_anisotropy",
                                          "sliding_fraction",
                                          "mean_normal_force_N",
                                          "max_overlap_over_radius",
                                          "energy_kinetic_J",
                                          "energy_grains_elastic_J",
                                          "energy_friction_loss_J",
                                          "energy_viscous_loss_J",
                                          "energy_curvature_work_J",
                                          "energy_cell_work_J",
                                          "energy_residual_J"};

} // namespace

std::vector<std::string> SampleFigures::names()
{
  return {"n_particles",
          "n_steps",
          "generated_solid_fraction",
          "solid_fraction",
          "coordination_number",
          "final_solid_fraction",
          "final_stress_ratio",
          "energy_residual",
          "max_overlap_over_radius",
          "stable_time_step_s",
          "time_step_s",
          "undecided_contacts",
          "wall_time_s"};
}

std::vector<double> SampleFigures::values() const
{
  return {static_cast<double>(n_particles),
          static_cast<double>(n_steps),
          generated_solid_fraction,
          solid_fraction,
          coordination_number,
          final_solid_fraction,
          final_stress_ratio,
          energy_residual,
          largest_overlap,
          stable_step,
          time_step,
          static_cast<double>(n_undecided),
          wall_time};
}

SampleFigures SampleFigures::from(const std::vector<double> &v)
{
  SampleFigures f;
  f.n_particles = static_cast<std::int64_t>(v.at(0));
  f.n_steps = static_cast<std::int64_t>(v.at(1));
  f.generated_solid_fraction = v.at(2);
  f.solid_fraction = v.at(3);
  f.coordination_number = v.at(4);
  f.final_solid_fraction = v.at(5);
  f.final_stress_ratio = v.at(6);
  f.energy_residual = v.at(7);
  f.largest_overlap = v.at(8);
  f.stable_step = v.at(9);
  f.time_step = v.at(10);
  f.n_undecided = static_cast<std::int64_t>(v.at(11));
  f.wall_time = v.at(12);
  return f;
}

SampleRun::SampleRun(const RveParameters &p, const SampleSettings &s, std::filesystem::path sample_folder,
                     std::string text, SampleProgress &shown)
    : parameters(p), settings(s), folder(std::move(sample_folder)), parameter_text(std::move(text)), progress(shown),
      program(p.program(s)), snapshot_timer(p.snapshot_interval)
{
}

bool SampleRun::run()
{
  const bool goes_on = std::filesystem::exists(folder / "snapshot.h5");
  if (goes_on)
    read_snapshot();
  else
    begin();
  progress.particles = static_cast<std::int64_t>(simulation->particles.size());
  while (stage < static_cast<std::int64_t>(program.size()))
  {
    loading->prepare(*simulation);
    const bool ends = loading->is_finished();
    if (simulation->n_steps >= next_row || ends)
      record();
    if (simulation->n_steps >= next_distribution || ends)
      record_distributions(simulation->time);
    simulation->integrate();
    ++progress.steps_here;
    if (ends)
      end_stage();
    if (simulation->n_steps % 50 != 0)
      continue;
    const bool is_stopped = interrupted();
    if (is_stopped || snapshot_timer.is_due())
      write_snapshot();
    if (is_stopped)
      return false;
    if (loading)
      progress.fraction = (stage + loading->progress(*simulation)) / static_cast<double>(program.size());
  }
  f.n_steps = simulation->n_steps;
  f.n_undecided = simulation->contacts.n_undecided();
  f.wall_time = wall_time_before + std::chrono::duration<double>(Clock::now() - start).count();
  progress.fraction = 1.;
  return true;
}

void SampleRun::begin()
{
  std::filesystem::create_directories(folder);
  dem::PackingParameters packing;
  packing.solid_fraction = parameters.packing_solid_fraction;
  packing.density = parameters.simulation.grain().density;
  const Vec3 edges = Vec3::Constant(settings.edge);
  const auto space = dem::PackingSpace::periodic({Vec3::Zero(), edges});
  dem::PackedGrains packed = dem::pack_grains(parameters.grading(), space, packing, settings.seed);
  if (!packed.report.has_reached_target)
    throw RunError("the geometric packing got stuck at a solid fraction of " +
                   std::to_string(packed.report.solid_fraction) + " of " + std::to_string(packing.solid_fraction) +
                   ": choose a smaller Packing/solid fraction");
  packed.particles.cell = dem::PeriodicCell(edges);
  dem::SimulationParameters p = parameters.simulation;
  p.between_grains().friction = settings.generation_friction;
  p.time_step = program[0].time_step;
  simulation = std::make_unique<dem::Simulation>(p, std::move(packed.particles), std::vector<dem::PlaneWall>{});
  f.n_particles = static_cast<std::int64_t>(simulation->particles.size());
  grain = dem::mean_grain(simulation->particles);
  solid_volume = dem::solid_volume(simulation->particles);
  history.emplace(folder / "history.csv", columns);
  distributions.emplace(folder / "distributions.csv", distribution_columns());
  begin_stage();
}

void SampleRun::begin_stage()
{
  loading.emplace(program[stage], grain, parameters.simulation.grain().density);
  loading->begin(*simulation);
  next_row = next_distribution = simulation->n_steps;
}

void SampleRun::end_stage()
{
  const double fraction = solid_volume / simulation->particles.cell.volume();
  if (stage == 0)
    f.generated_solid_fraction = fraction;
  if (stage + 2 == static_cast<std::int64_t>(program.size()) || program.size() == 1)
  {
    f.solid_fraction = fraction;
    f.coordination_number = 2. * simulation->contacts.n_touching() / static_cast<double>(f.n_particles);
  }
  if (parameters.pictures)
  {
    const std::string name = "grains_000" + std::to_string(stage) + ".vtu";
    dem::write_grains_vtu(simulation->particles, {}, folder / name);
  }
  ++stage;
  if (stage < static_cast<std::int64_t>(program.size()))
    begin_stage();
}

/// Rows are close to one another where a stage begins to strain, for the stiffness at small strains.
std::int64_t SampleRun::steps_to_next_row() const
{
  const dem::LoadingStage &s = loading->stage();
  if (!s.is_strained())
    return parameters.row_interval;
  double whole = 0.;
  for (int leg = 0; leg < dem::n_legs(s); ++leg)
    whole += std::abs(dem::end_of_leg(s, leg) - (leg == 0 ? 0. : dem::end_of_leg(s, leg - 1)));
  const double regular = whole / parameters.n_rows, here = std::abs(loading->strain(*simulation)[2]);
  const double spacing = loading->state().leg > 0. ? regular
                         : here < 1e-3             ? std::min(regular, 2e-5)
                         : here < 1e-2             ? std::min(regular, 2e-4)
                                                   : regular;
  return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(spacing / (loading->rate() * simulation->parameters().time_step)));
}

void SampleRun::record()
{
  const dem::Simulation &s = *simulation;
  s.check_finite();
  const std::vector<dem::TouchingContact> contacts = s.contacts.touching(s.particles);
  const double volume = s.particles.cell.volume();
  const dem::AssemblyMeasures m =
      dem::measure_assembly(s.particles, contacts, {}, s.parameters().between_grains().friction, volume);
  const dem::GrainEnergy e = s.energy();
  if (s.n_steps == 0)
    first_balance = e.balance();
  const double residual = e.balance() - first_balance;
  const Vec3 strain = loading->strain(s);
  const Vec3 rates = s.particles.cell.rate.cwiseQuotient(s.particles.cell.edges);
  const double overlap = dem::largest_relative_overlap(contacts, s.particles);
  const double fraction = solid_volume / volume;
  const double pressure = dem::pressure(m.stress);
  const double inertial = dem::inertial_number(grain, rates.cwiseAbs().maxCoeff(), pressure);

  f.largest_overlap = std::max(f.largest_overlap, overlap);
  if (std::abs(e.cell_work) > 0.)
    f.energy_residual = std::max(f.energy_residual, std::abs(residual) / std::max(std::abs(e.cell_work), e.stored()));
  f.final_solid_fraction = fraction;
  f.final_stress_ratio = 2. * m.stress(2, 2) / (m.stress(0, 0) + m.stress(1, 1));
  if (!std::isfinite(f.final_stress_ratio))
    f.final_stress_ratio = 0.;
  const double row[] = {s.time,
                        static_cast<double>(stage),
                        strain[0],
                        strain[1],
                        strain[2],
                        (strain + Vec3::Ones()).prod() - 1.,
                        m.stress(0, 0),
                        m.stress(1, 1),
                        m.stress(2, 2),
                        0.5 * (m.stress(0, 1) + m.stress(1, 0)),
                        0.5 * (m.stress(0, 2) + m.stress(2, 0)),
                        0.5 * (m.stress(1, 2) + m.stress(2, 1)),
                        fraction,
                        inertial,
                        static_cast<double>(m.n_contacts),
                        m.coordination.mean,
                        m.coordination.mechanical,
                        m.coordination.without_rattlers,
                        static_cast<double>(m.coordination.n_rattlers) / static_cast<double>(f.n_particles),
                        m.fabric(0, 0),
                        m.fabric(1, 1),
                        m.fabric(2, 2),
                        dem::fabric_anisotropy(m.fabric),
                        m.sliding_fraction,
                        m.mean_normal_force,
                        overlap,
                        e.kinetic,
                        e.normal + e.tangential,
                        e.friction_loss,
                        e.viscous_loss,
                        e.curvature_work,
                        e.cell_work,
                        residual};
  history->append(row);
  if (overlap > 0.2)
    throw RunError("the run diverged: grains overlap by " + std::to_string(overlap) + " of their radius at time " +
                   std::to_string(s.time) + " s; choose a smaller time step or a smaller inertial number");
  next_row = s.n_steps + steps_to_next_row();
}

void SampleRun::record_distributions(const double time)
{
  const std::vector<dem::TouchingContact> contacts = simulation->contacts.touching(simulation->particles);
  distributions->append(distribution_row(time, stage, contacts, simulation->parameters().between_grains().friction));
  const double stable = simulation->stable_time_step(), used = simulation->parameters().time_step;
  if (used / stable >= f.time_step / f.stable_step)
  {
    f.stable_step = stable;
    f.time_step = used;
  }
  const dem::LoadingStage &s = loading->stage();
  const double spacing = std::abs(s.axial_strain) / parameters.n_distributions;
  const double step = loading->rate() * simulation->parameters().time_step;
  next_distribution = simulation->n_steps + (s.is_strained() ? std::max<std::int64_t>(1, std::llround(spacing / step))
                                                             : 50 * parameters.row_interval);
}

void SampleRun::write_snapshot() const
{
  const std::lock_guard guard(archives);
  ArchiveWriter archive(folder / "snapshot.h5", snapshot_kind);
  archive.write("parameters", parameter_text);
  archive.write("sample", settings.number);
  dem::write_simulation(archive, *simulation);
  SampleFigures now = f;
  now.wall_time = wall_time_before + std::chrono::duration<double>(Clock::now() - start).count();
  archive.write("figures", now.values());
  archive.write("stage", stage);
  archive.write("next_row", next_row);
  archive.write("next_distribution", next_distribution);
  archive.write("first_balance", first_balance);
  const dem::CellLoading::State &state = loading->state();
  archive.write("loading/edges", std::span<const double>(state.edges.data(), 3));
  archive.write("loading/applied", std::span<const double>(state.applied.data(), 3));
  archive.write("loading/start_time", state.start_time);
  archive.write("loading/leg", state.leg);
  archive.write("loading/n_checks_passed", state.n_checks_passed);
  archive.commit();
}

void SampleRun::read_snapshot()
{
  const std::lock_guard guard(archives);
  const ArchiveReader archive(folder / "snapshot.h5", snapshot_kind);
  if (archive.read_text("parameters") != parameter_text)
    throw ConfigError("the snapshot " + (folder / "snapshot.h5").string() +
                      " belongs to other parameters; restart with those of the run, or start anew in another "
                      "folder");
  stage = archive.read_integer("stage");
  dem::SimulationParameters p = parameters.simulation;
  p.contact.overlap_tolerance = program.at(stage).overlap_tolerance;
  simulation = dem::read_simulation(archive, p);
  f = SampleFigures::from(archive.read_doubles("figures"));
  wall_time_before = f.wall_time;
  next_row = archive.read_integer("next_row");
  next_distribution = archive.read_integer("next_distribution");
  first_balance = archive.read_double("first_balance");
  dem::CellLoading::State state;
  archive.read_into("loading/edges", std::span<double>(state.edges.data(), 3));
  archive.read_into("loading/applied", std::span<double>(state.applied.data(), 3));
  state.start_time = archive.read_double("loading/start_time");
  state.leg = archive.read_double("loading/leg");
  state.n_checks_passed = archive.read_double("loading/n_checks_passed");
  grain = dem::mean_grain(simulation->particles);
  solid_volume = dem::solid_volume(simulation->particles);
  loading.emplace(program[stage], grain, parameters.simulation.grain().density);
  loading->resume(state);
  // The snapshot was taken after a step: its row, if any, lies before.
  const double last = simulation->time - 0.5 * simulation->parameters().time_step;
  history.emplace(History::continued(folder / "history.csv", columns, last));
  distributions.emplace(History::continued(folder / "distributions.csv", distribution_columns(), last));
}

} // namespace bergamo::driver
