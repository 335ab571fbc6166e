#pragma once

#include "coupling/adapter/model_energy.h"
#include "coupling/adapter/two_scale_model.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/overlap_waves/parameters.h"

#include <array>
#include <memory>
#include <vector>

namespace bergamo::driver
{

/// The three parts of a column, from below.
enum ColumnPart : int
{
  continuum_part,
  overlap_part,
  grain_part
};

/// A column along z that repeats itself in x and y: a cubic lattice of spheres above, the solid of the same moduli
/// below, joined in an overlap; or spheres all the way. Ends of grains bear the pressure as a dead load, the
/// continuum's is a quiet boundary. All moves in one direction, that of the wave: elements are held in both others.
class WaveColumn
{
public:
  /// @param grains stored ones, or none for the lattice at rest
  /// @throws ConfigError for a time step above the stable one
  WaveColumn(const WaveParameters &parameters, std::unique_ptr<dem::Simulation> grains);

  /// @name One step
  /// @{
  void compute(); ///< forces and kick
  void move();
  /// @}

  double time() const { return model.grains()->time; }                   ///< [s]
  double stable_step() const { return model.stable_steps().combined(); } ///< [s]

  double pulse_work() const { return work_of_pulse; } ///< of what sends the pulse [J]
  /// Energies less all works, which stays what it is [J]. After compute().
  double balance() const { return coupling::energy_of(model).balance() - work_of_pulse - work_of_pressure; }
  /// Kinetic energy of each part, by places at the start; see ColumnPart [J].
  std::array<double, 3> kinetic_energy() const;

  /// A layer of grains or of nodes.
  struct Layer
  {
    double is_continuum; ///< 1 or 0
    double place;        ///< z at the start [m]
    double velocity;     ///< mean, in the wave's direction [m/s]
  };
  std::vector<Layer> layers() const; ///< of the grains from below, then of the nodes

  void visit(StateVisitor &visit); ///< all but the grains

  coupling::TwoScaleModel model;

private:
  void join();
  void begin();
  ColumnPart part_at(double z) const;
  double end_force(double time) const;
  std::size_t layer_of(std::int64_t id) const { return id / (parameters.width * parameters.width); }

  const WaveParameters &parameters;
  CubicLattice lattice;
  Pulse pulse;
  int direction; // of the wave's motion
  double overlap_bottom, overlap_top;
  std::vector<std::int64_t> free_ends, source_grains;
  std::vector<unsigned int> source_nodes;
  std::vector<Vec3> dead_load;                      // on the free ends [N]
  double work_of_pulse = 0., work_of_pressure = 0.; // [J]
};

} // namespace bergamo::driver
