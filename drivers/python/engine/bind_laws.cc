#include "drivers/python/engine/bindings.h"

#include "dem/law/restitution.h"
#include "drivers/python/engine/parameters.h"

namespace bergamo::python
{

void bind_laws(pybind11::module_ &module)
{
  module.def("damping_ratio_of", &dem::damping_ratio_of);
  module.def("restitution_of_ratio", &dem::restitution_of_ratio);
  module.def("restitution", &dem::restitution);
  module.def("relaxation_time", &dem::relaxation_time);
  module.def("check_parameters", [](const pybind11::handle &object) { parameters_of(object); });
}

} // namespace bergamo::python
