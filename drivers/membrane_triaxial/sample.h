#pragma once

#include "dem/measure/assembly_measures.h"
#include "dem/simulation/energy.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/table.h"
#include "drivers/common/summary.h"
#include "drivers/membrane_triaxial/cell.h"
#include "fe_dealii/body_energy.h"

#include <string>
#include <vector>

namespace bergamo::driver
{

/// What strains count from.
struct SampleStart
{
  double height = 0., volume = 0.; ///< [m, m³]

  void visit(StateVisitor &visit, const std::string &name);
};

/// A row of a history: the cell as the laboratory sees it, and what the grains say of themselves.
class CellSample
{
public:
  /// Between compute and move. @param time since the stage began [s]; @param rate of the axial strain [1/s]
  /// @throws RunError for overlaps that say that the run has diverged
  void measure(const TriaxialCell &cell, const SampleStart &start, double time, double rate);

  Table table() const;                          ///< rows of history.csv; must not outlive the sample
  Table shape_table(std::size_t n_rings) const; ///< rows of shape.csv, the same

  double time = 0.; ///< [s]
  double height = 0., volume = 0., axial_strain = 0., volumetric_strain = 0.;
  double pressure = 0., axial_stress = 0., membrane_stress = 0.; ///< [Pa]
  double solid_fraction = 0., inertial_number = 0.;
  double plate_difference = 0.; ///< force on the lower plate less that on the upper one [N]
  double largest_overlap = 0.;
  std::vector<double> radii; ///< of the membrane's rings, from below [m]
  dem::AssemblyMeasures grains;
  dem::GrainEnergy grain_energy;
  fe::BodyEnergy membrane_energy;
  double pressure_work = 0., plate_work = 0.; ///< the latter on the grains alone [J]
  EnergyResidual residual;

  double stress_ratio() const { return axial_stress / pressure; } ///< as the laboratory has it
  /// Mean normal stress of the grains across the axis, compression positive [Pa].
  double lateral_stress() const { return -0.5 * (grains.stress(0, 0) + grains.stress(1, 1)); }
};

/// What samples of a test tell.
class TestFigures
{
public:
  /// Takes in a sample of the compression.
  void look(const CellSample &sample);
  void end_loading(const CellSample &sample); ///< the last one before the compression
  void add_to(Summary &summary) const;
  void visit(StateVisitor &visit);

  double largest_overlap = 0.;

private:
  double loaded_solid_fraction = 0., loaded_coordination = 0., loaded_axial = 0., loaded_lateral = 0.;
  double peak_ratio = 0., peak_strain = 0.;
  double final_ratio = 0., final_strain = 0., final_solid_fraction = 0., final_volumetric_strain = 0.;
  double bulge = 0.; // radius half-way up over that of the rims
};

} // namespace bergamo::driver
