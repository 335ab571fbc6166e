#pragma once

#include "drivers/common/progress.h"
#include "drivers/common/run/state_visitor.h"
#include "fe_dealii/moving_body.h"

namespace bergamo::driver
{

/// Keeps the greatest rotation of an element of a body of small strain, and warns once where it is too much for that.
class RotationWatch
{
public:
  void look(const fe::MovingBody &body, Progress &progress);

  double greatest() const { return greatest_; } ///< of all looks [degrees]

  void visit(StateVisitor &visit) { visit("rotation/greatest", greatest_); }

private:
  double greatest_ = 0;
};

} // namespace bergamo::driver
