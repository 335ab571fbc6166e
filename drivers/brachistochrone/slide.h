#pragma once

#include "dem/simulation/simulation.h"
#include "drivers/brachistochrone/figures.h"
#include "drivers/brachistochrone/parameters.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/table.h"

#include <memory>

namespace bergamo::driver
{

/// A sphere that touches the track at its start, at rest, and goes down to its end.
class Slide
{
public:
  Slide(const SlideParameters &parameters, const SlideSettings &settings);

  dem::Simulation &grains() { return *simulation; }
  double time() const { return simulation->time; }        ///< [s]
  double exact_travel_time() const { return exact_time; } ///< [s]
  bool has_arrived() const { return f.travel_time > 0.; }

  /// @name Of the present step, between kick and drift
  /// @{
  void look(); ///< compares it with the closed form, while both are on their way
  void look_at_energy();
  /// @}

  Table table() const; ///< of the last look at the energy; must not outlive the slide
  const SlideFigures &figures() const { return f; }

  void visit(StateVisitor &visit);

private:
  const Vec3 &centre() const { return simulation->particles.position[0]; }
  Vec3 exact_centre() const;

  const SlideParameters &parameters;
  std::unique_ptr<Path> path;
  double exact_time; // [s]
  std::unique_ptr<dem::Simulation> simulation;
  Vec3 last_centre = Vec3::Zero(); // of the last look [m]
  double last_time = 0.;           // [s]
  std::int64_t n_looks = 0, n_airborne = 0;
  dem::GrainEnergy energy;
  EnergyResidual residual;
  SlideFigures f;
};

} // namespace bergamo::driver
