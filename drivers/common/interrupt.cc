#include "drivers/common/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <string_view>

namespace bergamo::driver
{

namespace
{

volatile std::sig_atomic_t received_signal = 0;
std::atomic<int> n_watches = 0;
static_assert(std::atomic<int>::is_always_lock_free); // read by the signal handler

void say(const std::string_view message)
{
  const int saved_errno = errno;
  [[maybe_unused]] const auto ignored = ::write(STDERR_FILENO, message.data(), message.size());
  errno = saved_errno;
}

extern "C" void on_signal(const int signal_number) // only calls that are safe in a signal handler
{
  if (received_signal != 0 && signal_number == SIGHUP) // comes in twos, or with SIGTERM, from shells and systemd
    return;
  if (received_signal != 0 || n_watches == 0)
  {
    if (received_signal == 0)
      say("\nstopped; there was nothing yet to go on from\n");
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
    return;
  }
  received_signal = signal_number;
  say("\nstopping after this step; Ctrl-C again ends the program at once\n");
}

} // namespace

void install_interrupt_handler()
{
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) // nohup: the run is to outlive its terminal
    sigaction(SIGHUP, &action, nullptr);
}

InterruptWatch::InterruptWatch()
{
  ++n_watches;
}

InterruptWatch::~InterruptWatch()
{
  --n_watches;
}

bool interrupted()
{
  return received_signal != 0;
}

int interrupt_signal()
{
  return received_signal;
}

void clear_interrupt()
{
  received_signal = 0;
}

} // namespace bergamo::driver
