#pragma once

#include "coupling/model/coupling.h"
#include "coupling/model/mover.h"
#include "coupling/model/stable_steps.h"

#include <concepts>
#include <memory>
#include <vector>

namespace bergamo::coupling
{

/// Movers and the couplings between them, stepped together (the order of Wellmann's fig. 6.3). A mover that no coupling
/// acts on moves as it would alone, bit for bit.
class Model
{
public:
  /// Takes a part in, and gives it back for the calls of its own kind. Parts take their turns in the order in which
  /// they came. @throws ConfigError for a coupling of a mover that is no part of the model
  template <std::derived_from<Mover> Part>
  Part &add(std::unique_ptr<Part> mover)
  {
    Part &part = *mover;
    movers_.push_back(std::move(mover));
    return part;
  }
  template <std::derived_from<Coupling> Part>
  Part &add(std::unique_ptr<Part> coupling)
  {
    require_movers_of(*coupling);
    Part &part = *coupling;
    couplings_.push_back(std::move(coupling));
    return part;
  }

  /// @name One step, see Mover; energies are read between kick() and drift()
  /// @{
  void compute_forces();
  void kick(double time_step);
  void drift(double time_step);

  void step(const double time_step)
  {
    compute_forces();
    kick(time_step);
    drift(time_step);
  }
  /// @}

  const std::vector<std::unique_ptr<Mover>> &movers() const { return movers_; }
  const std::vector<std::unique_ptr<Coupling>> &couplings() const { return couplings_; }

  /// At the present state.
  StableSteps stable_steps() const;

private:
  void require_movers_of(const Coupling &coupling) const;

  std::vector<std::unique_ptr<Mover>> movers_;
  std::vector<std::unique_ptr<Coupling>> couplings_;
};

} // namespace bergamo::coupling
