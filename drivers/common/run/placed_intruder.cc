#include "drivers/common/run/placed_intruder.h"

#include "coupling/adapter/surface_contact.h"

#include <memory>
#include <utility>

namespace bergamo::driver
{

PlacedIntruder place_intruder(coupling::Model &model, coupling::GrainsMover &grains, Intruder intruder,
                              const std::string &name)
{
  PlacedIntruder placed;
  placed.parts = std::move(intruder.parts);
  placed.mover = &model.add(std::make_unique<coupling::RigidMover>(intruder.body, name));
  if (grains.simulation().surfaces.empty())
  {
    dem::Surface surface = coupling::surface_of(placed.mover->body());
    surface.material = intruder_material;
    grains.simulation().add_surface(std::move(surface));
  }
  model.add(std::make_unique<coupling::SurfaceContact>(grains, *placed.mover, placed.parts.surface));
  return placed;
}

} // namespace bergamo::driver
