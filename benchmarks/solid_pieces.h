#pragma once

#include "benchmarks/solid_case.h"

#include "fe_dealii/element/element_group.h"

#include <memory>

namespace bergamo::benchmark
{

/// The pieces of a solid's forces by themselves, on one thread, on copies of its present state: each step has the
/// increment of the last one. The kernels stay as they are, without clocks in them.
class SolidPieces
{
public:
  SolidPieces(const SolidCase &what, MovingSolid &solid);

  /// Seconds of the loop over the elements: gather, strain, stress and forces, without the sums at the nodes.
  double time_elements(int n_steps);

  /// Seconds of the constitutive law: from strain increments (small strain) or deformation gradients (large strain) to
  /// stresses and energies at all points. The strains of 32 elements at a time, prepared off the clock, lie in the
  /// cache, where an element's loop has them, too; the histories stream from memory as they do in a step.
  double time_law(int n_steps);

private:
  const SolidCase &what;
  MovingSolid &solid;
  std::unique_ptr<fe::ElementGroup> elements;
  std::vector<double> before, now;
};

} // namespace bergamo::benchmark
