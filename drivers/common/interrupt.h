#pragma once

namespace bergamo::driver
{

/// From now on, Ctrl-C (SIGINT) and SIGTERM raise a flag that the run loop reads after each step; a second one of them
/// ends the program at once.
void install_interrupt_handler();

/// Whether the run has been asked to stop.
bool interrupted();

/// The signal that asked the run to stop, or 0.
int interrupt_signal();

/// Takes the flag back.
void clear_interrupt();

} // namespace bergamo::driver
