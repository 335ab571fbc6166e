#pragma once

namespace bergamo::driver
{

/// From now on, Ctrl-C (SIGINT), SIGTERM and the loss of the terminal (SIGHUP, unless it is ignored, as under nohup)
/// raise a flag that the run loop reads after each step; a second SIGINT or SIGTERM ends the program at once. Where
/// nobody watches the flag, the first one does.
void install_interrupt_handler();

/// While one of them lives, somebody watches the flag now and then. Long work that does not belongs before it.
class InterruptWatch
{
public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch &) = delete;
  InterruptWatch &operator=(const InterruptWatch &) = delete;
};

/// Whether the run has been asked to stop.
bool interrupted();

/// The signal that asked the run to stop, or 0.
int interrupt_signal();

/// Takes the flag back.
void clear_interrupt();

} // namespace bergamo::driver
