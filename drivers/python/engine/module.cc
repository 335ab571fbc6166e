#include "drivers/python/engine/bindings.h"

#include "dem/core/pack.h"
#include "drivers/python/engine/errors.h"
#include "drivers/python/engine/team.h"

PYBIND11_MODULE(_engine, module)
{
  using namespace bergamo::python;
  register_errors();
  module.def("set_team", &set_team);
  module.def("team", &team);
  module.attr("pack_width") = bergamo::pack_width;
  bind_laws(module);
  bind_grains(module);
  bind_surfaces(module);
  bind_packing(module);
  pybind11::object model = bind_model(module);
  bind_bodies(model);
  bind_readings(model);
  bind_loading(model);
}
