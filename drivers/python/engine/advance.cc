#include "drivers/python/engine/advance.h"

#include "dem/core/error.h"
#include "drivers/python/engine/errors.h"

#include <chrono>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

/// Looks for signals now and then: Python's lock may cost another thread's time slice.
class SignalWatch
{
public:
  void look()
  {
    const auto now = Clock::now();
    if (now - last_ < interval)
      return;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    last_ = Clock::now();
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{50};
  Clock::time_point last_ = Clock::now();
};

class Block
{
public:
  explicit Block(Model &model) : model_(model)
  {
    if (model.is_in_step)
      throw Busy("a callback cannot step the simulation that calls it: it goes on by itself when the callback returns");
    if (!model.failure.empty())
      throw RunError("the simulation has failed in an earlier step and cannot go on: " + model.failure);
    model.is_in_step = true;
    model.is_stopped = false;
  }
  ~Block() { model_.is_in_step = false; }
  Block(const Block &) = delete;
  Block &operator=(const Block &) = delete;

private:
  Model &model_;
};

void call_due(const Model &model, const std::int64_t n_steps, const std::vector<Callback> &callbacks)
{
  for (const Callback &callback : callbacks)
    if (n_steps % callback.every == 0)
    {
      const py::gil_scoped_acquire lock;
      callback.call();
      if (model.is_stopped)
        return;
    }
}

void make_step(Model &model, const Course &course)
{
  const std::int64_t before = model.simulation().n_steps;
  try
  {
    course.step();
  }
  catch (const RunError &error)
  {
    if (model.simulation().n_steps == before)
      model.failure = error.what();
    throw;
  }
}

} // namespace

std::vector<Callback> callbacks_of(const py::list &pairs)
{
  std::vector<Callback> callbacks;
  for (const py::handle &item : pairs)
  {
    const auto pair = py::cast<py::tuple>(item);
    callbacks.push_back({py::cast<std::int64_t>(pair[0]), py::cast<py::function>(pair[1])});
    const std::int64_t every = callbacks.back().every;
    require(every >= 1, "number of steps between two calls", static_cast<double>(every), "at least 1");
  }
  return callbacks;
}

std::int64_t advance(Model &model, const Course &course, const std::vector<Callback> &callbacks)
{
  const Work work(model);
  const Block block(model);
  const py::gil_scoped_release unlocked;
  SignalWatch signals;
  const dem::Simulation &simulation = model.simulation();
  const std::int64_t first = simulation.n_steps;
  while (!model.is_stopped && !course.is_done())
  {
    course.prepare();
    make_step(model, course);
    call_due(model, simulation.n_steps, callbacks);
    signals.look();
  }
  return simulation.n_steps - first;
}

} // namespace bergamo::python
