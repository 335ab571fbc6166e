#include "drivers/common/run/rotation_watch.h"

#include "fe_dealii/rotation.h"

#include <algorithm>
#include <sstream>

namespace bergamo::driver
{

void RotationWatch::look(const fe::MovingBody &body, Progress &progress)
{
  const fe::ElementRotation now = fe::greatest_rotation(body);
  const bool bears_any = body.elements().stiffens_with_displacement(); // of large strain
  if (!bears_any && greatest_ <= fe::largest_small_rotation && now.angle > fe::largest_small_rotation)
  {
    std::ostringstream message;
    message << body.describe(now.element) << " turned by " << now.angle << " degrees; strains are small, so beyond "
            << fe::largest_small_rotation << " degrees stresses come from the rotation too: load less, or take elements of large strain";
    progress.warn(message.str());
  }
  greatest_ = std::max(greatest_, now.angle);
}

} // namespace bergamo::driver
