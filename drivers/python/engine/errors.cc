#include "drivers/python/engine/errors.h"

#include "dem/core/error.h"

#include <pybind11/pybind11.h>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

void raise(const char *name, const std::exception &error)
{
  const py::object type = py::module_::import("bergamo.engine.errors").attr(name);
  PyErr_SetString(type.ptr(), error.what());
}

} // namespace

void register_errors()
{
  py::register_exception_translator(
      [](std::exception_ptr thrown)
      {
        try
        {
          if (thrown)
            std::rethrow_exception(thrown);
        }
        catch (const ConfigError &error)
        {
          raise("ConfigError", error);
        }
        catch (const RunError &error)
        {
          raise("RunError", error);
        }
        catch (const StaleView &error)
        {
          raise("StaleView", error);
        }
        catch (const Busy &error)
        {
          raise("Busy", error);
        }
      });
}

} // namespace bergamo::python
