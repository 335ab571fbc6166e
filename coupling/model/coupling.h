#pragma once

#include "coupling/model/mover.h"

#include <string>
#include <vector>

namespace bergamo::coupling
{

/// Forces between movers, or on them from outside: an overlap of two models, a contact of surfaces, a load.
class Coupling
{
public:
  explicit Coupling(std::string name) : name_(std::move(name)) {}
  virtual ~Coupling() = default;
  Coupling(const Coupling &) = delete;
  Coupling &operator=(const Coupling &) = delete;

  const std::string &name() const { return name_; } ///< for messages and tables

  /// Adds its forces at the present places to those on the movers. Called once their own forces are known.
  virtual void apply() = 0;

  /// Follows the movers once all of them have drifted, before forces are asked for again. @param time_step drifted [s]
  virtual void follow(double /*time_step*/) {}

  /// What it acts on.
  virtual std::vector<const Mover *> movers() const = 0;

  /// Largest stable step of the coupling alone, with the masses that it moves [s]; infinite for one without stiffness.
  virtual double stable_step() = 0;

  virtual double energy() const { return 0.; } ///< stored at the last apply() [J]

private:
  std::string name_;
};

} // namespace bergamo::coupling
