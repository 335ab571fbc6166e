#pragma once

#include "dem/simulation/simulation.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace bergamo::python
{

class LentArray;

/// A simulation that Python holds, with the arrays of it that NumPy reads in place. All of it, and of LentArray, needs
/// Python's lock, but for what a Work does to the simulation.
class Model : public std::enable_shared_from_this<Model>
{
public:
  /// Shared from its birth, since arrays that are lent keep it alive.
  static std::shared_ptr<Model> make(std::unique_ptr<dem::Simulation> simulation);

  /// An array of the particles by its name in Particles::visit_fields(). Throws ConfigError for a name that is not
  /// there. @return the same one again while it is held and has not moved
  std::shared_ptr<LentArray> lend(const std::string &name);

  /// Takes back what is lent, before the arrays move: who holds it keeps the memory, but is told that it is old.
  /// @param name of the one array, all if empty
  void recall(const std::string &name = "");

  /// Throws Busy where another thread has it.
  void require_free() const;

  dem::Simulation &simulation() { return *simulation_; }

  bool is_in_step = false;              ///< a block of steps is under way
  std::atomic<bool> is_stopped = false; ///< it ends after this step; any thread may say so
  std::string failure = "";             ///< why no step may follow

private:
  friend class Work;

  explicit Model(std::unique_ptr<dem::Simulation> simulation);

  std::unique_ptr<dem::Simulation> simulation_;
  std::vector<std::weak_ptr<LentArray>> lent_;
  std::thread::id worker_; // that has the simulation, none otherwise
};

/// One thread has a simulation for as long as this lives, with the team of threads that was chosen; it may take it
/// again in between, as a callback does. Throws Busy where another one has it.
class Work
{
public:
  explicit Work(Model &model);
  ~Work();
  Work(const Work &) = delete;
  Work &operator=(const Work &) = delete;

private:
  Model &model_;
  std::thread::id before_;
};

/// An array of a simulation's particles that NumPy reads in place.
class LentArray
{
public:
  LentArray(std::shared_ptr<Model> owner, std::string name);

  const std::string &name() const { return name_; }
  bool is_current() const { return !kept_; }

  /// Throws StaleView for one that was taken back, Busy where another thread has the simulation.
  void check() const;

  void *data = nullptr;
  std::size_t n_rows = 0, n_columns = 1;
  bool is_integer = false; ///< of 64 bits; doubles otherwise

  /// Leaves a copy to the simulation and keeps the memory itself, with no number in it: whatever still reads it finds
  /// nothing that it could take for a result.
  template <class T>
  void take(std::vector<T> &values)
  {
    std::vector<T> copy = values;
    kept_ = std::make_shared<std::vector<T>>(std::exchange(values, std::move(copy)));
    wipe();
  }

private:
  void wipe();

  std::shared_ptr<Model> owner_;
  std::string name_;
  std::shared_ptr<void> kept_;
};

} // namespace bergamo::python
