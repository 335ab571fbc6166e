#pragma once

#include "dem/loading/piston.h"
#include "dem/simulation/simulation.h"
#include "drivers/common/run/state_visitor.h"
#include "drivers/common/run/table.h"
#include "drivers/membrane_triaxial/membrane.h"

#include <memory>

namespace bergamo::driver
{

/// Numbers of what bounds the sample in its simulation.
enum SampleBounds : std::int32_t
{
  lower_plate = 0, ///< of the walls
  upper_plate = 1,
  side = 0 ///< of the surfaces: rigid, then the membrane's
};

/// Grains packed in a rigid smooth prism between two plates, which shrinks evenly, its width and its height each like a
/// piston under the pressure, until they bear that and rest (Wellmann 4.3.4, 5.1.3).
class Mould
{
public:
  explicit Mould(const MembraneTriaxialParameters &p) : parameters(p) {}

  /// Draws, places and tightens the grains. @return false where the user has interrupted that
  /// @throws ConfigError where they find no place, RunError where the tightening gets stuck
  bool fill();

  /// @name One step
  /// @{
  void compute(); ///< forces and kick
  void move() { grains->drift(); }
  /// @}

  /// Whether the pressure holds and the grains rest, as of the last look. @throws RunError after the longest time
  void look();
  bool is_finished() const { return n_looks_passed >= 5.; }

  Table table() const; ///< rows of mould.csv, as of the last look; must not outlive the mould

  Prism prism() const;
  dem::Simulation &sample() { return *grains; }
  double time() const { return grains->time; } ///< [s]

  /// Drifts on, takes all speeds away and gives the grains out, with the parameters of the test.
  std::unique_ptr<dem::Simulation> take();

  void visit(StateVisitor &visit);

private:
  double pressure_on_side() const;
  double pressure_on_plates() const;

  const MembraneTriaxialParameters &parameters;
  std::unique_ptr<dem::Simulation> grains;
  double n_looks_passed = 0.;                          // in a row
  double on_plates = 0., on_side = 0., unbalance = 1.; // of the last look [Pa, Pa, -]
};

/// Mean force of the plates on the grains, inwards [N].
double plate_force(const dem::Simulation &sample);

/// Moves the plates towards one another. @param speed of each over the drift to come [m/s]
void set_plates(dem::Simulation &sample, double speed);

/// A plate as a piston. @param push of the pressure less that of the grains [N]; @param fastest [m/s]
dem::Piston plate_piston(const dem::Simulation &sample, double push, double fastest);

} // namespace bergamo::driver
