#include "drivers/python/engine/model.h"

#include "dem/core/error.h"
#include "drivers/python/engine/errors.h"
#include "drivers/python/engine/team.h"

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace bergamo::python
{

Model::Model(std::unique_ptr<dem::Simulation> simulation) : simulation_(std::move(simulation))
{
  simulation_->before_moving = [this]
  {
    const pybind11::gil_scoped_acquire lock;
    recall();
  };
}

std::shared_ptr<Model> Model::make(std::unique_ptr<dem::Simulation> simulation)
{
  return std::shared_ptr<Model>(new Model(std::move(simulation)));
}

std::shared_ptr<LentArray> Model::lend(const std::string &name)
{
  require_free();
  std::erase_if(lent_, [](const auto &lent) { return lent.expired(); });
  for (const auto &lent : lent_)
    if (const auto array = lent.lock(); array && array->name() == name && array->is_current())
      return array;
  const auto array = std::make_shared<LentArray>(shared_from_this(), name);
  bool is_there = false;
  dem::Particles::visit_fields(simulation_->particles,
                               [&](const std::string &field, auto &values)
                               {
                                 if (field != name)
                                   return;
                                 using T = typename std::remove_reference_t<decltype(values)>::value_type;
                                 is_there = true;
                                 array->data = values.data();
                                 array->n_rows = values.size();
                                 array->n_columns = sizeof(T) / sizeof(double);
                                 array->is_integer = std::is_integral_v<T>;
                               });
  if (!is_there)
    throw ConfigError("grains have no array '" + name + "'");
  lent_.push_back(array);
  return array;
}

void Model::recall(const std::string &name)
{
  for (const auto &lent : lent_)
    if (const auto array = lent.lock(); array && array->is_current() && (name.empty() || array->name() == name))
      dem::Particles::visit_fields(simulation_->particles,
                                   [&](const std::string &field, auto &values)
                                   {
                                     if (field == array->name())
                                       array->take(values);
                                   });
  std::erase_if(lent_, [](const auto &lent) { return lent.expired() || !lent.lock()->is_current(); });
}

void Model::require_free() const
{
  if (worker_ != std::thread::id() && worker_ != std::this_thread::get_id())
    throw Busy("another thread is stepping this simulation or reading its forces: wait until it is done");
}

Work::Work(Model &model) : model_(model), before_(model.worker_)
{
  model.require_free();
  model.worker_ = std::this_thread::get_id();
  take_team();
}

Work::~Work()
{
  model_.worker_ = before_;
}

LentArray::LentArray(std::shared_ptr<Model> owner, std::string name) : owner_(std::move(owner)), name_(std::move(name))
{
}

void LentArray::check() const
{
  if (!is_current())
    throw StaleView("this view of '" + name_ +
                    "' is no longer of the simulation: grains were sorted, added or removed, " +
                    "or the array was replaced; take it anew from the simulation, or copy what is to stay");
  owner_->require_free();
}

void LentArray::wipe()
{
  const std::size_t n = n_rows * n_columns;
  if (is_integer)
    std::fill_n(static_cast<std::int64_t *>(data), n, -1);
  else
    std::fill_n(static_cast<double *>(data), n, std::numeric_limits<double>::quiet_NaN());
}

} // namespace bergamo::python
