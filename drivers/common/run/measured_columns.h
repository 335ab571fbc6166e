#pragma once

#include "drivers/common/run/table.h"

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
}
} // namespace bergamo

namespace bergamo::driver
{

/// Columns of history.csv for what the library measures: one place for the names that the plots and fit_mohr_coulomb
/// read. What is measured must outlive the columns.
/// @{
std::vector<Column> columns_of(const dem::CellMeasures &cell); ///< strains, stresses and so on to energies, no time
std::vector<Column> columns_of(const coupling::ModelEnergy &energy);
/// @}

} // namespace bergamo::driver
