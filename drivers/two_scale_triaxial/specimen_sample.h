#pragma once

#include "coupling/adapter/model_energy.h"
#include "coupling/adapter/stress_profile.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/summary.h"

#include <filesystem>
#include <vector>

namespace bergamo::driver
{

/// What is read of a step, and the columns of history.csv.
struct SpecimenSample
{
  double time = 0.;                                  ///< of the loading [s]
  int stage = 1;                                     ///< 1: isotropic, 2: shear
  Vec3 strain = Vec3::Zero(), stress = Vec3::Zero(); ///< tension positive [-], [Pa]
  coupling::ModelEnergy energy;
  double residual = 0.;                                  ///< of the energy's balance since the first sample [J]
  double coordination_number = 0., largest_overlap = 0.; ///< of the grains; the overlap over the smaller radius
  double coupling_difference = 0.;                       ///< largest, between both models' displacements [m]
  std::vector<coupling::SlabStress> profile{};           ///< of the cube, a slab a layer of elements

  void add_figures(Summary &summary) const; ///< stresses, and how much the joint shows

  Table table() const
  {
    Table table{{{"time_s", [this] { return time; }},
                 {"stage", [this] { return stage; }},
                 {"strain_1", [this] { return strain[0]; }},
                 {"strain_2", [this] { return strain[1]; }},
                 {"strain_3", [this] { return strain[2]; }},
                 {"stress_1_Pa", [this] { return stress[0]; }},
                 {"stress_2_Pa", [this] { return stress[1]; }},
                 {"stress_3_Pa", [this] { return stress[2]; }}}};
    table.add(columns_of(energy));
    table.add({{"energy_residual_J", [this] { return residual; }},
               {"coordination_number", [this] { return coordination_number; }},
               {"max_overlap_over_radius", [this] { return largest_overlap; }},
               {"coupling_difference_m", [this] { return coupling_difference; }},
               {"stress_3_unevenness", [this] { return coupling::unevenness(profile); }}});
    return table;
  }
};

/// Stresses of both models with their weights, slab by slab, as stress_profile.csv.
void write_profile(const std::filesystem::path &path, const std::vector<coupling::SlabStress> &profile);

} // namespace bergamo::driver
