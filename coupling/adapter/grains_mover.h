#pragma once

#include "coupling/model/mover.h"
#include "dem/simulation/simulation.h"

#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <unordered_set>

namespace bergamo::coupling
{

/// Grains as a mover. Their external forces are those of couplings and last for one step.
class GrainsMover final : public Mover
{
public:
  explicit GrainsMover(std::unique_ptr<dem::Simulation> grains, std::string name = "grains");

  void compute_forces() override;
  void kick(double time_step) override;  ///< RunError for a step that is not the simulation's own
  void drift(double time_step) override; ///< the same
  double stable_step() override;
  MoverEnergy energy() const override;

  dem::Simulation &simulation() { return *grains_; }
  const dem::Simulation &simulation() const { return *grains_; }

  /// Weights, in (0, 1], of grains that share their space with a continuum, by id: they multiply masses and contact
  /// forces. A grain gets its weight once: ConfigError for a second overlap.
  void set_weights(std::span<const std::int64_t> id, std::span<const double> weight);

  /// Goes on with other weights and other grains, see dem::Simulation::change_weights(). @param old_id the grains that
  /// had weights from the same overlap, which have 1 where they are not among the others
  void change_weights(std::span<const std::int64_t> old_id, std::span<const std::int64_t> id,
                      std::span<const double> weight);

  /// Leaves the work of a surface out of energy(): it belongs to another mover of the model.
  void share_surface(std::int32_t surface) { shared_surfaces_.insert(surface); }

private:
  void weigh(std::span<const std::int64_t> id, std::span<const double> weight);

  std::unique_ptr<dem::Simulation> grains_;
  std::unordered_set<std::int64_t> shared_; // ids of the grains with weights
  std::set<std::int32_t> shared_surfaces_;
};

} // namespace bergamo::coupling
