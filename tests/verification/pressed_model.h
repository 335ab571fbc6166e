#pragma once

#include "coupling/adapter/two_scale_model.h"
#include "dem/packing/space.h"

#include <memory>
#include <vector>

/// A cube of 6 mm under pressure, grains above and continuum below.
namespace bergamo::test
{

constexpr double confining_pressure = 1e5; // [Pa]

/// A dense packing between six walls under pressure, at rest.
std::unique_ptr<dem::Simulation> make_pressed_packing();

/// Takes the grains of the lower third of a box and the wall below out of a packing.
/// @return those grains, where they lay
dem::Particles cut_below(dem::Simulation &grains, const dem::Box &box);

/// The packing, of which a continuum takes the place of the lower third and shares the middle one.
/// @param gravity from the first step on, downwards [m/s2]
coupling::TwoScaleModel make_pressed_model(const coupling::CouplingParameters &join, double gravity = 0.);

/// Grains of which those in the lower third of a box are gone, with a continuum on rollers in the lower two thirds, as
/// heavy as the grains and under their gravity.
coupling::TwoScaleModel join_below(std::unique_ptr<dem::Simulation> grains, const dem::Box &box,
                                   const coupling::CouplingParameters &join, const std::vector<Vec3> &reference_by_id);

void run(coupling::TwoScaleModel &model, int n_steps);

} // namespace bergamo::test
