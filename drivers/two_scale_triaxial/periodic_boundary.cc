#include "drivers/two_scale_triaxial/specimen_boundary.h"

#include <array>
#include <cmath>
#include <optional>

namespace bergamo::driver
{
namespace
{

unsigned int nearest_node(const fe::ExplicitBody &body, const Vec3 &place)
{
  unsigned int nearest = 0;
  double least = HUGE_VAL;
  for (unsigned int node = 0; node < body.n_nodes(); ++node)
  {
    const auto &x = body.node_position()[node];
    const double distance = (Vec3(x[0], x[1], x[2]) - place).squaredNorm();
    if (distance < least && !body.images().has(node))
    {
      least = distance;
      nearest = node;
    }
  }
  return nearest;
}

class PeriodicBoundary final : public SpecimenBoundary
{
public:
  PeriodicBoundary(coupling::TwoScaleModel &models, const Vec3 &cell) : model(models), edges(cell)
  {
    fe::ExplicitBody *const body = model.body();
    if (!body)
      return;
    body->repeat({true, true, !model.grains()});
    held_node = nearest_node(*body, 0.5 * edges);
    for (unsigned int d = 0; d < 3; ++d)
      held[d] = body->prescribe_velocity(std::array{held_node}, d);
  }

  void move(const Vec3 &velocity) override
  {
    if (dem::Simulation *const grains = model.grains())
    {
      dem::PeriodicCell &cell = grains->particles.cell;
      cell.acceleration = (velocity - cell.rate) / grains->steps().next_kick;
    }
    fe::ExplicitBody *const body = model.body();
    if (!body)
      return;
    body->set_face_velocity({velocity[0], velocity[1], velocity[2]});
    for (int d = 0; d < 3; ++d)
      body->set_velocity(*held[d], velocity[d] * body->node_position()[held_node][d] / edges[d]);
  }

  Vec3 stress(const Vec3 &, const SpecimenSample &sample) const override
  {
    Vec3 sum = Vec3::Zero();
    for (const coupling::SlabStress &slab : sample.profile)
      sum += slab.total();
    return sum / static_cast<double>(sample.profile.size());
  }

private:
  coupling::TwoScaleModel &model;
  Vec3 edges; // at the start
  unsigned int held_node = 0;
  std::array<std::optional<fe::ExplicitBody::Constraint>, 3> held;
};

} // namespace

std::unique_ptr<SpecimenBoundary> in_periodic_cell(coupling::TwoScaleModel &model, const Vec3 &edges)
{
  return std::make_unique<PeriodicBoundary>(model, edges);
}

} // namespace bergamo::driver
