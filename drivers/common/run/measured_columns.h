#pragma once

#include "drivers/common/run/table.h"

#include <string>
#include <vector>

namespace bergamo
{
namespace coupling
{
struct ModelEnergy;
}
namespace dem
{
struct CellMeasures;
struct GrainEnergy;
struct SurfaceLoad;
} // namespace dem
} // namespace bergamo

namespace bergamo::driver
{

/// Columns of history.csv for what the library measures: one place for the names that the plots and fit_mohr_coulomb
/// read. What is measured must outlive the columns.
/// @{
std::vector<Column> columns_of(const dem::CellMeasures &cell); ///< strains, stresses and so on to energies, no time
std::vector<Column> columns_of(const coupling::ModelEnergy &energy);
std::vector<Column>
columns_of(const dem::GrainEnergy &energy); ///< of grains among walls and surfaces, that come and go

/// Force on each surface and its moment about the origin, of as many surfaces as there are names ("floor_force_z_N");
/// @param loads as Simulation::surface_loads() lists them; those that are not there any more have none
std::vector<Column> columns_of(const std::vector<dem::SurfaceLoad> &loads, const std::vector<std::string> &names);
/// @}

} // namespace bergamo::driver
