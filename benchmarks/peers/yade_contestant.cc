#include "benchmarks/peers/yade_contestant.h"

#include "benchmarks/peers/peer_files.h"
#include "dem/core/whole_file.h"

#include <cmath>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

nlohmann::json numbers(const Vec3 &x)
{
  return {x.x(), x.y(), x.z()};
}

nlohmann::json materials_of(const dem::MaterialTable &materials)
{
  nlohmann::json list = nlohmann::json::array(), pairs = nlohmann::json::array();
  for (std::int32_t i = 0; i < materials.size(); ++i)
  {
    list.push_back({{"young", materials[i].young_modulus},
                    {"poisson", materials[i].poisson_ratio},
                    {"density", materials[i].density}});
    for (std::int32_t j = 0; j <= i; ++j)
    {
      const dem::SurfacePair &pair = materials.between(i, j);
      pairs.push_back(
          {{"materials", {j, i}}, {"friction_angle", std::atan(pair.friction)}, {"damping_ratio", pair.damping_ratio}});
    }
  }
  return {{"list", list}, {"pairs", pairs}};
}

nlohmann::json beads_of(const dem::Particles &beads)
{
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t i = 0; i < beads.size(); ++i)
    list.push_back({{"id", beads.id[i]},
                    {"material", beads.parts.material[i]},
                    {"radius", beads.bounding_radius[i]},
                    {"position", numbers(beads.position[i])},
                    {"velocity", numbers(beads.velocity[i])},
                    {"spin", numbers(spin_of(beads, i))}});
  return list;
}

} // namespace

YadeContestant::YadeContestant(std::filesystem::path program) : program(std::move(program)), folder("bergamo_yade") {}

std::string YadeContestant::execute(const BulkCase &bulk, const double distance, const nlohmann::json &job) const
{
  nlohmann::json input{{"materials", materials_of(bulk.parameters.materials)},
                       {"beads", beads_of(bulk.beads)},
                       {"vessel", "vessel.stl"},
                       {"vessel_material", bulk.vessel.material},
                       {"vessel_spin", bulk.vessel_spin},
                       {"gravity", numbers(bulk.parameters.gravity)},
                       {"time_step", bulk.parameters.time_step},
                       {"distance", distance * mean_radius(bulk)},
                       {"job", job}};
  if (std::isfinite(bulk.outlet))
    input["outlet"] = bulk.outlet;
  write_whole_file(folder.path() / "vessel.stl", stl_text(bulk.vessel));
  write_whole_file(folder.path() / "case.json", input.dump());
  return output_of(program, "-n -x -j1 " + quoted(BERGAMO_YADE_SCRIPT), folder.path());
}

Track YadeContestant::run(const BulkCase &bulk, const double distance)
{
  nlohmann::json job{
      {"samples", bulk.n_samples}, {"steps_between_samples", bulk.steps_between_samples}, {"track", "track.txt"}};
  if (bulk.only_bead != BulkCase::all)
    job["only_bead"] = bulk.only_bead;
  execute(bulk, distance, job);
  return read_track(folder.path() / "track.txt", bulk.parameters.time_step, 0);
}

double YadeContestant::time(const BulkCase &bulk, const int n_steps, const double distance)
{
  const std::string output = execute(bulk, distance, {{"warm_up_steps", warm_up_steps}, {"timed_steps", n_steps}});
  return number_after(output, "seconds of the steps: ");
}

} // namespace bergamo::benchmark
