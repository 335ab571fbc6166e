#include "coupling/adapter/grains_mover.h"

#include "dem/core/error.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <vector>

namespace bergamo::coupling
{
namespace
{

void require_own_step(const dem::Simulation &grains, const double time_step)
{
  const double own = grains.parameters().time_step;
  if (time_step == own)
    return;
  std::ostringstream message;
  message << "grains: a step of " << time_step << " s is asked for, theirs is " << own
          << " s; give the model the time step of its grains";
  throw RunError(message.str());
}

} // namespace

GrainsMover::GrainsMover(std::unique_ptr<dem::Simulation> grains, std::string name)
    : Mover(std::move(name)), grains_(std::move(grains))
{
}

void GrainsMover::compute_forces()
{
  for (std::vector<Vec3> *external : {&grains_->particles.external_force, &grains_->particles.external_torque})
    std::fill(external->begin(), external->end(), Vec3::Zero());
  grains_->compute_forces();
}

void GrainsMover::kick(const double time_step)
{
  require_own_step(*grains_, time_step);
  grains_->kick();
}

void GrainsMover::drift(const double time_step)
{
  require_own_step(*grains_, time_step);
  grains_->drift();
}

double GrainsMover::stable_step()
{
  return grains_->stable_time_step();
}

MoverEnergy GrainsMover::energy() const
{
  const dem::GrainEnergy e = grains_->energy();
  double work = e.wall_work + e.cell_work + e.gravity_work + e.curvature_work + e.search_work + e.quadrature_work +
                e.exchanged + e.step_change;
  for (const std::int32_t surface : shared_surfaces_)
    work -= grains_->surfaces[surface].work;
  return {e.kinetic, e.normal + e.tangential, e.friction_loss + e.viscous_loss, work};
}

void GrainsMover::set_weights(const std::span<const std::int64_t> id, const std::span<const double> weight)
{
  for (const std::int64_t grain : id)
    if (shared_.contains(grain))
      reject("grain ", grain, " lies in two overlaps; let overlaps have no grain in common");
  shared_.insert(id.begin(), id.end());
  weigh(id, weight);
}

void GrainsMover::change_weights(const std::span<const std::int64_t> old_id, const std::span<const std::int64_t> id,
                                 const std::span<const double> weight)
{
  for (const std::int64_t grain : old_id)
    shared_.erase(grain);
  set_weights(id, weight);
  std::vector<std::int64_t> free;
  std::copy_if(old_id.begin(), old_id.end(), std::back_inserter(free),
               [&](const std::int64_t grain) { return !shared_.contains(grain); });
  weigh(free, std::vector<double>(free.size(), 1.));
}

void GrainsMover::weigh(const std::span<const std::int64_t> id, const std::span<const double> weight)
{
  std::vector<std::int32_t> places;
  for (const std::int64_t grain : id)
    places.push_back(grains_->index_of(grain));
  grains_->change_weights(places, weight);
}

} // namespace bergamo::coupling
