#include "drivers/rubber_block/pull.h"

#include "coupling/model/energy_balance.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/rubber_block/block.h"

#include <vector>

namespace bergamo::driver
{

Pull::Pull(const RubberBlockParameters &p, std::unique_ptr<dem::Simulation> sand, const double height)
    : parameters(p), step(p.simulation.time_step), seconds_of_settling(sand->times.total())
{
  const Vec3 corner(p.start_offset, 0.5 * (p.sand.box[1] - p.block.edges[1]), height);
  std::unique_ptr<fe::ExplicitBody> made = make_block(p.block, corner, p.gravity);
  solid = made.get();
  const fe::FaceTriangles faces = block_faces(*made, p.block);
  dem::Surface start = coupling::surface_of(*made, faces);
  start.material = block_material;
  pressure_below.emplace(start, 2 * std::size_t(p.block.squares) * p.block.squares, corner[0], p.block.edges[0],
                         p.block.n_along);
  guide = made->prescribe_velocity(block_top, 0);
  made->prescribe_velocity(block_top, 1);
  top_node = made->boundary_nodes(block_top).front();
  for (std::size_t node = 0; node < made->n_nodes(); ++node)
    weight_of_block -= made->weight(3 * node + 2);

  grains = &model.add(std::make_unique<coupling::GrainsMover>(std::move(sand), "sand"));
  block = &model.add(std::make_unique<ClockedBody>(std::move(made), "block"));
  if (grains->simulation().surfaces.empty()) // else it was stored with the grains
    grains->simulation().add_surface(std::move(start));
  model.add(std::make_unique<coupling::SurfaceContact>(*grains, *block, faces, surface));
  pressure_above = &model.add(std::make_unique<TopPressure>(*block, solid->dof_handler(), block_top));
}

void Pull::compute(const double time)
{
  Stopwatch watch;
  pressure_above->set(parameters.pressure_at(time));
  block->body().set_velocity(guide, parameters.speed_at(time + 0.5 * step));
  model.compute_forces();
  model.kick(step);
  watch.lap(seconds);
}

void Pull::move()
{
  Stopwatch watch;
  model.drift(step);
  watch.lap(seconds);
}

double Pull::energy_balance() const
{
  return coupling::energy_balance(model) - pressure_above->work();
}

double Pull::work() const
{
  return solid->energy().boundary_work + pressure_above->work();
}

StepShares Pull::shares() const
{
  const double of_grains = (sand().times.total() - seconds_of_settling) / seconds,
               of_block = block->seconds() / seconds;
  return {of_grains, of_block, 1. - of_grains - of_block};
}

void Pull::visit_block(StateVisitor &visit)
{
  visit_body(visit, block->body());
  pressure_above->visit(visit);
}

} // namespace bergamo::driver
