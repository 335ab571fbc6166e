#include "drivers/common/forecast/step_trial.h"

#include "drivers/common/run/wall_clock.h"
#include "fe_dealii/moving_body.h"
#include "fe_dealii/stable_step.h"

#include <algorithm>
#include <vector>

namespace bergamo::driver
{

double seconds_of(const std::function<void()> &step)
{
  constexpr double block = 0.05; // s
  constexpr int n_blocks = 5;
  step(); // the first one makes what the others use again
  std::vector<double> seconds;
  for (int k = 0; k < n_blocks; ++k)
  {
    const double begin = wall_clock();
    int n = 0;
    while (n == 0 || wall_clock() - begin < block)
    {
      step();
      ++n;
    }
    seconds.push_back((wall_clock() - begin) / n);
  }
  std::nth_element(seconds.begin(), seconds.begin() + n_blocks / 2, seconds.end());
  return seconds[n_blocks / 2];
}

double seconds_of_step(fe::MovingBody &body)
{
  constexpr double share = 1e-3; // of the stable step: nothing holds the body, and it is to stay what it is
  const double time_step = share * fe::stable_step(body).time_step;
  constexpr double speed = 1e-3; // m/s, of all of it: where nothing moves, nothing is computed
  std::fill(body.velocity().begin(), body.velocity().end(), speed);
  return seconds_of(
      [&]
      {
        body.compute_internal_force();
        body.kick(time_step);
        body.drift(time_step);
      });
}

} // namespace bergamo::driver
