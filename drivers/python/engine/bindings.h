#pragma once

#include <pybind11/pybind11.h>

/// What the module consists of; the package bergamo.engine explains it, and checks shapes first.
namespace bergamo::python
{

void bind_grains(pybind11::module_ &module);
void bind_surfaces(pybind11::module_ &module);
void bind_packing(pybind11::module_ &module);
void bind_laws(pybind11::module_ &module);
pybind11::object bind_model(pybind11::module_ &module);
void bind_bodies(pybind11::object &model);
void bind_readings(pybind11::object &model);
void bind_loading(pybind11::object &model);

} // namespace bergamo::python
