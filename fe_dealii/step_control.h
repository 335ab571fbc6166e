#pragma once

#include "fe_dealii/stable_step.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bergamo::fe
{

/// Keeps the stable step of a body through an explicit run, and a time step that follows it.
///
/// Asked for after compute_internal_force() and before kick(), in every step: the stresses of the present step set the
/// stiffness of the next. Where the law's stiffness depends on the pressure alone, the eigenvalues of the elements are
/// found once and multiplied; where it depends on the displacement, those of an element are found anew once its nodes
/// have moved against each other by half a percent of their least distance, so that between two looks the step is true
/// to some percent.
class StepControl
{
public:
  /// @param body must outlive it, and keep its masses (shares, mass scaling)
  explicit StepControl(const MovingBody &body);

  /// The step to take from here [s]: it shrinks at once with the stable step, and grows by a percent at most. Throws
  /// RunError, with element, place and time, where a stiffness is not finite.
  /// @param share of the stable step; ConfigError unless it is between 0 and 1
  double next(double share);

  /// For a run whose step is given [s]. Throws RunError, with element, place and time, where it is above the stable
  /// one.
  void require_stable(double time_step);

  const StableStep &stable() const { return stable_; }             ///< of the last look, or of the start
  double smallest_stable() const { return kept_.smallest_stable; } ///< of all looks [s]
  double smallest_step() const { return kept_.smallest_step; }     ///< of all that next() gave [s]; 0 before

  /// What a restart needs, as views.
  std::vector<std::pair<std::string, std::span<double>>> state();

private:
  void look();
  void find_eigenvalue(std::size_t element);
  bool has_deformed(std::size_t element) const; // by much since its eigenvalue was found
  double shortest_distance(std::size_t element) const;

  const MovingBody &body_;
  std::vector<double> eigenvalue_; // of each element, with the law's own moduli where these depend on the pressure
  std::vector<double> present_;    // with those of the present stresses
  // Where the stiffness depends on the displacement: that of the elements' nodes when their eigenvalues were found, and
  // how far they may move against each other until they are found again.
  std::vector<double> displacement_, tolerance_;
  StableStep stable_{};

  struct Kept // doubles only: it is part of the state
  {
    double smallest_stable = 0, smallest_step = 0, last_step = 0;
  };
  Kept kept_;
};

} // namespace bergamo::fe
