#include "drivers/common/progress.h"

#include "drivers/common/number_text.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace bergamo::driver
{

namespace
{

constexpr double live_interval = 0.2;   // s between two renewals of the live line
constexpr double plain_interval = 10.0; // s between two plain lines
constexpr double memory = 5.0;          // s over which the shown rate is smoothed

std::string two_digits(const long number)
{
  return (number < 10 ? "0" : "") + std::to_string(number);
}

/// 1234567 as "1.23 M".
std::string with_prefix(const double number)
{
  struct Prefix
  {
    double factor;
    const char *name;
  };
  constexpr std::array prefixes = {Prefix{1e9, " G"}, Prefix{1e6, " M"}, Prefix{1e3, " k"}};
  for (const Prefix &prefix : prefixes)
    if (number >= 0.9995 * prefix.factor)
      return short_text(number / prefix.factor, number >= 999.5 * prefix.factor ? 6 : 3) + prefix.name;
  return short_text(number, 3);
}

std::string percent(const double fraction)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%5.1f %%", 100 * std::clamp(fraction, 0.0, 1.0));
  return text.data();
}

} // namespace

std::string format_duration(const double seconds)
{
  const long whole = std::lround(std::clamp(seconds, 0.0, 1e9));
  if (whole < 60)
    return std::to_string(whole) + " s";
  if (whole < 3600)
    return std::to_string(whole / 60) + " min " + two_digits(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + two_digits(whole % 3600 / 60) + " min";
}

std::string format_progress(const ProgressLine &line)
{
  std::string text = line.stage + "  " + percent(line.fraction) + "  t = " + short_text(line.time_s, 4) + " s";
  if (line.steps_per_second >= 0)
    text += "  " + with_prefix(line.steps_per_second) + " steps/s";
  if (line.particle_steps_per_second >= 0)
    text += "  " + with_prefix(line.particle_steps_per_second) + " particle-steps/s";
  if (line.seconds_left >= 0)
    text += "  " + format_duration(line.seconds_left) + " left";
  return text;
}

ProgressOptions ProgressOptions::standard(const bool quiet)
{
  ProgressOptions options;
  options.quiet = quiet;
  options.is_terminal = ::isatty(STDERR_FILENO) == 1;
  winsize size{};
  if (options.is_terminal && ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1)
    options.max_width = size.ws_col - 1u;
  options.stream = &std::cerr;
  options.clock = wall_clock;
  return options;
}

Progress::Progress(ProgressOptions options) : options(std::move(options)) {}

Progress::~Progress() // also on the way of an exception: leaves the cursor at the beginning of a line
{
  if (live_width > 0)
    *options.stream << std::endl;
}

void Progress::begin_stage(const std::string &name, const ProgressState &state)
{
  end_stage();
  stage = name;
  in_stage = true;
  first = shown = latest = state;
  first_clock = shown_clock = options.clock();
  steps_per_second = -1;
  if (!options.quiet && options.is_terminal)
    show(state, first_clock);
}

void Progress::update(const ProgressState &state)
{
  latest = state;
  if (options.quiet || !in_stage)
    return;
  const double now = options.clock();
  if (now - shown_clock >= (options.is_terminal ? live_interval : plain_interval))
    show(state, now);
}

void Progress::end_stage()
{
  if (!in_stage)
    return;
  in_stage = false;
  if (options.quiet)
    return;
  const double seconds = std::max(options.clock() - first_clock, 1e-9);
  ProgressLine line = {.stage = stage, .fraction = latest.fraction, .time_s = latest.time_s};
  line.steps_per_second = static_cast<double>(latest.steps - first.steps) / seconds; // over the whole stage
  line.particle_steps_per_second = line.steps_per_second * static_cast<double>(latest.particles);
  const std::string text = format_progress(line) + "  " + format_duration(seconds);
  if (options.is_terminal)
    write_live(text);
  else
    *options.stream << text;
  *options.stream << std::endl;
  live_width = 0;
}

void Progress::note(const std::string &text)
{
  if (!options.quiet)
    write_above(text);
}

void Progress::warn(const std::string &text)
{
  write_above("warning: " + text);
}

void Progress::write_above(const std::string &line)
{
  if (live_width > 0)
    write_live("");
  *options.stream << (live_width > 0 ? "\r" : "") << line << std::endl;
  live_width = 0;
  if (in_stage && options.is_terminal && !options.quiet)
    show(latest, options.clock());
}

void Progress::show(const ProgressState &state, const double now)
{
  const double interval = now - shown_clock;
  if (interval > 0 && state.steps > shown.steps)
  {
    const double rate = static_cast<double>(state.steps - shown.steps) / interval;
    const double weight = steps_per_second < 0 ? 1 : 1 - std::exp(-interval / memory);
    steps_per_second = steps_per_second < 0 ? rate : steps_per_second + weight * (rate - steps_per_second);
  }
  ProgressLine line = {.stage = stage, .fraction = state.fraction, .time_s = state.time_s};
  line.steps_per_second = steps_per_second;
  line.particle_steps_per_second = steps_per_second * static_cast<double>(state.particles);
  if (state.fraction > first.fraction)
    line.seconds_left = (now - first_clock) * (1 - state.fraction) / (state.fraction - first.fraction);
  if (options.is_terminal)
    write_live(format_progress(line));
  else
    *options.stream << format_progress(line) << std::endl;
  shown = state;
  shown_clock = now;
}

void Progress::write_live(const std::string &line)
{
  const std::string text = line.substr(0, options.max_width);
  const std::size_t n_blanks = live_width > text.size() ? live_width - text.size() : 0;
  *options.stream << '\r' << text << std::string(n_blanks, ' ') << std::flush;
  live_width = std::max(text.size(), std::size_t(1));
}

} // namespace bergamo::driver
