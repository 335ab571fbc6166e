#pragma once

#include "drivers/two_scale_triaxial/packing_stage.h"
#include "fe_dealii/explicit_body.h"

#include <memory>

namespace bergamo::driver
{

/// The continuum's part of the cube, none for grains alone: it starts with the stresses of the grains whose place it
/// takes, so that the overlap and the walls start in equilibrium.
std::unique_ptr<fe::ExplicitBody> make_continuum(const TriaxialParameters &parameters, const LoadingStart &start);

} // namespace bergamo::driver
