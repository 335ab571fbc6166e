#include "drivers/python/engine/advance.h"
#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"
#include "drivers/python/engine/parameters.h"
#include "drivers/python/engine/saved_simulation.h"
#include "drivers/python/engine/team.h"

#include <cmath>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

using Shared = py::class_<Model, std::shared_ptr<Model>>;

std::shared_ptr<Model> make(const py::handle &parameters, const dem::Particles &grains, const py::list &planes)
{
  std::vector<dem::PlaneWall> walls;
  for (const py::handle &plane : planes)
    walls.push_back(wall_of(plane));
  take_team();
  return Model::make(std::make_unique<dem::Simulation>(parameters_of(parameters), grains, std::move(walls)));
}

std::int64_t step(Model &model, const std::int64_t n_steps, const py::list &callbacks)
{
  require(n_steps >= 0, "number of steps", static_cast<double>(n_steps), "at least 0");
  dem::Simulation &simulation = model.simulation();
  const std::int64_t end = simulation.n_steps + n_steps;
  return advance(model, {[&] { return simulation.n_steps >= end; }, [&] { simulation.step(); }},
                 callbacks_of(callbacks));
}

/// To the step that is nearest to a time [s].
std::int64_t run_until(Model &model, const double time, const py::list &callbacks)
{
  require(std::isfinite(time), "time to run until", time, "finite [s]");
  dem::Simulation &simulation = model.simulation();
  return advance(
      model,
      {[&] { return simulation.time + 0.5 * simulation.parameters().time_step > time; }, [&] { simulation.step(); }},
      callbacks_of(callbacks));
}

/// Of the particles, in place: the memory is kept as long as the array is.
py::array array_of_lent(const std::shared_ptr<LentArray> &lent)
{
  const auto rows = static_cast<py::ssize_t>(lent->n_rows), columns = static_cast<py::ssize_t>(lent->n_columns);
  const std::vector<py::ssize_t> shape = columns == 1 ? std::vector{rows} : std::vector{rows, columns};
  const py::object base = py::cast(lent);
  if (lent->is_integer)
    return py::array_t<std::int64_t>(shape, static_cast<const std::int64_t *>(lent->data), base);
  return py::array_t<double>(shape, static_cast<const double *>(lent->data), base);
}

/// Of all grains, a row each, or none (0, 3) [N], or [N m].
void set_external(Model &model, const std::string &name, const Doubles &values)
{
  const Work work(model);
  dem::Particles &grains = model.simulation().particles;
  std::vector<Vec3> rows = rows_of<Vec3>(values, name);
  require(rows.empty() || rows.size() == grains.size(), "number of rows of " + name, static_cast<double>(rows.size()),
          "that of the grains, " + std::to_string(grains.size()) + ", or 0");
  model.recall(name);
  (name == "external_force" ? grains.external_force : grains.external_torque) = std::move(rows);
}

/// @return ids, in the order of the grains that were added
py::array add(Model &model, const dem::Particles &grains)
{
  const Work work(model);
  return array_of(model.simulation().add(grains).ids);
}

/// @return ids, in the order of the arrays
py::array remove(Model &model, const Integers &rows)
{
  const Work work(model);
  std::vector<std::int32_t> leaving;
  for (py::ssize_t k = 0; k < rows.size(); ++k)
    leaving.push_back(static_cast<std::int32_t>(rows.data()[k]));
  return array_of(model.simulation().remove(leaving).ids);
}

void change(Model &model, const py::handle &parameters)
{
  const Work work(model);
  model.simulation().change(parameters_of(parameters));
}

void bind_lent(py::module_ &module)
{
  py::class_<LentArray, std::shared_ptr<LentArray>>(module, "LentArray")
      .def("check", &LentArray::check)
      .def_property_readonly("array", &array_of_lent)
      .def_property_readonly("name", &LentArray::name)
      .def_property_readonly("is_current", &LentArray::is_current);
}

/// Reads a plain figure, where no other thread has the simulation.
template <class Read>
auto reading(Read read)
{
  return [read](Model &model)
  {
    model.require_free();
    return read(model.simulation());
  };
}

} // namespace

py::object bind_model(py::module_ &module)
{
  bind_lent(module);
  Shared model(module, "Model");
  model.def(py::init(&make))
      .def_static("load", [](const std::string &path) { return Model::make(load(path)); })
      .def("save",
           [](Model &model, const std::string &path, const std::string &parameters)
           {
             const Work work(model);
             save(model.simulation(), path, parameters);
           })
      .def("step", &step)
      .def("run_until", &run_until)
      .def("stop", [](Model &model) { model.is_stopped = true; })
      .def("lend", &Model::lend)
      .def("set_external", &set_external)
      .def("add", &add)
      .def("remove", &remove)
      .def("change", &change)
      .def_property_readonly("parameters", reading([](const dem::Simulation &s) { return dict_of(s.parameters()); }))
      .def_property_readonly("time", reading([](const dem::Simulation &s) { return s.time; }))
      .def_property_readonly("n_steps", reading([](const dem::Simulation &s) { return s.n_steps; }))
      .def_property_readonly("n_grains", reading([](const dem::Simulation &s) { return s.particles.size(); }))
      .def_property_readonly("n_orders", reading([](const dem::Simulation &s) { return s.n_orders(); }))
      .def_property_readonly("state_hash", reading([](const dem::Simulation &s) { return state_hash(s); }))
      .def("rest",
           [](Model &model)
           {
             const Work work(model);
             model.simulation().rest();
           })
      .def("reset_accounts",
           [](Model &model)
           {
             const Work work(model);
             model.simulation().reset_accounts();
           });
  return model;
}

} // namespace bergamo::python
