#include "drivers/common/run/bending_warning.h"

#include "fe_dealii/thin_layers.h"

#include <sstream>

namespace bergamo::driver
{

void warn_of_thin_layers(const fe::MovingBody &body, const std::string &remedy, Progress &progress)
{
  const fe::ThinLayers thin = fe::thin_layers(body);
  if (thin.n_elements == 0)
    return;
  std::ostringstream message;
  message << body.describe(thin.element) << " only " << thin.n_layers << (thin.n_layers == 1 ? " element" : " elements")
          << " over a thickness of " << thin.thickness << " m that is free to bend, and is " << thin.length
          << " m long; bent, it and others, " << thin.n_elements
          << " in all, are too stiff or too soft by any factor: " << remedy
          << ", or take two or more elements over the thickness that are no longer than half of it";
  progress.warn(message.str());
}

} // namespace bergamo::driver
