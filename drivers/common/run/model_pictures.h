#pragma once

#include "drivers/common/run/picture_series.h"

#include <vector>

namespace bergamo
{
namespace dem
{
class Simulation;
}
namespace fe
{
class ExplicitBody;
}
} // namespace bergamo

namespace bergamo::driver
{

/// What draws the models of a run that are there: "grains" with their weights and the forces that they are left with,
/// "surfaces" with what grains exert on them, "continuum"; and alone, "contacts" as lines with their forces. The models
/// must outlive it.
/// @{
std::vector<Picture> pictures_of(const dem::Simulation *grains, const fe::ExplicitBody *body);
Picture picture_of_surfaces(const dem::Simulation &grains);
Picture picture_of_contacts(const dem::Simulation &grains);
/// @}

} // namespace bergamo::driver
