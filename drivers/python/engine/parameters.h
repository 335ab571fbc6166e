#pragma once

#include "dem/simulation/simulation_parameters.h"
#include "dem/state/wall.h"

#include <pybind11/pybind11.h>

namespace bergamo::python
{

/// From an object with the attributes of bergamo.engine.Parameters. Throws ConfigError for a value out of its range.
dem::SimulationParameters parameters_of(const pybind11::handle &object);

/// From an object with the attributes of bergamo.engine.Plane.
dem::PlaneWall wall_of(const pybind11::handle &plane);

/// The attributes by name: materials (m, 3), surface_pairs (pairs, 3), by MaterialTable::pair_number(), and the
/// numbers.
pybind11::dict dict_of(const dem::SimulationParameters &parameters);

} // namespace bergamo::python
