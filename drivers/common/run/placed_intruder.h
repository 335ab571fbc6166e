#pragma once

#include "coupling/adapter/grains_mover.h"
#include "coupling/adapter/rigid_mover.h"
#include "coupling/model/model.h"
#include "drivers/common/intruder.h"

#include <string>

namespace bergamo::driver
{

/// An intruder in a model: what moves it, and its parts on the surface that the grains touch.
struct PlacedIntruder
{
  coupling::RigidMover *mover = nullptr;
  dem::SurfaceParts parts;
};

/// Adds an intruder and its contact with the grains to a model, and its surface, of intruder_material, to the grains,
/// unless it was stored with them. @param name of the mover; grains must be a mover of the model
PlacedIntruder place_intruder(coupling::Model &model, coupling::GrainsMover &grains, Intruder intruder,
                              const std::string &name);

} // namespace bergamo::driver
