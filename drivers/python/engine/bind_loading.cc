#include "drivers/python/engine/advance.h"
#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"

#include "dem/loading/cell_loading.h"
#include "dem/loading/compression.h"
#include "dem/simulation/cell_rules.h"

#include <map>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

dem::LoadingStage stage_of(const py::handle &object)
{
  static const std::map<std::string, dem::LoadingPath> paths{
      {"isotropic", dem::LoadingPath::isotropic},
      {"triaxial", dem::LoadingPath::triaxial},
      {"true_triaxial", dem::LoadingPath::true_triaxial},
      {"constant_volume", dem::LoadingPath::constant_volume},
      {"constant_pressure", dem::LoadingPath::constant_pressure}};
  const auto number = [&](const char *name) { return py::cast<double>(object.attr(name)); };
  const auto path = py::cast<std::string>(object.attr("path"));
  if (!paths.contains(path))
    throw ConfigError("the path of a loading is '" + path +
                      "': it must be isotropic, triaxial, true_triaxial, constant_volume or constant_pressure");
  dem::LoadingStage stage;
  stage.path = paths.at(path);
  stage.friction = number("friction");
  stage.pressure = number("pressure");
  stage.stresses = vector_of(object.attr("stresses"), "stresses of a loading");
  stage.inertial_number = number("inertial_number");
  stage.axial_strain = number("axial_strain");
  stage.n_cycles = py::cast<int>(object.attr("n_cycles"));
  stage.time_step = number("time_step");
  stage.overlap_tolerance = number("overlap_tolerance");
  stage.stress_tolerance = number("stress_tolerance");
  stage.force_tolerance = number("force_tolerance");
  stage.longest_time = number("longest_time");
  stage.validate();
  return stage;
}

/// However a loading ends, the cell goes on at the rate that it has then.
class HeldRate
{
public:
  explicit HeldRate(dem::PeriodicCell &cell) : cell_(cell) {}
  ~HeldRate() { cell_.acceleration.setZero(); }

private:
  dem::PeriodicCell &cell_;
};

std::int64_t load_cell(Model &model, const py::handle &stage, const double density, const py::list &callbacks)
{
  const Work work(model);
  dem::Simulation &simulation = model.simulation();
  if (!simulation.particles.cell.is_periodic())
    throw ConfigError("only a periodic cell can be loaded: give the grains a cell before the simulation is made");
  simulation.particles.cell.require_closed("the loading of a cell");
  dem::CellLoading loading(stage_of(stage), dem::mean_grain(simulation.particles), density);
  loading.begin(simulation);
  bool is_done = false;
  const auto prepare = [&]
  {
    loading.prepare(simulation);
    is_done = loading.is_finished();
  };
  const HeldRate held(simulation.particles.cell);
  return advance(model, {[&] { return is_done; }, [&] { simulation.integrate(); }, prepare}, callbacks_of(callbacks));
}

std::int64_t compress_box(Model &model, const py::handle &options, const py::list &callbacks)
{
  dem::CompressionParameters p;
  const auto number = [&](const char *name) { return py::cast<double>(options.attr(name)); };
  p.pressure = number("pressure");
  p.largest_rate = number("largest_rate");
  p.pressure_tolerance = number("pressure_tolerance");
  p.force_tolerance = number("force_tolerance");
  p.longest_time = number("longest_time");
  const Work work(model);
  dem::Simulation &simulation = model.simulation();
  require(simulation.walls.size() >= 6, "number of planes of a box that is compressed",
          static_cast<double>(simulation.walls.size()), "at least six: add box_planes(low, high) first");
  dem::Compression compression(p);
  return advance(model, {[&] { return compression.is_finished(); }, [&] { compression.step(simulation); }},
                 callbacks_of(callbacks));
}

} // namespace

void bind_loading(py::object &object)
{
  py::class_<Model, std::shared_ptr<Model>> model = object;
  model.def("load_cell", &load_cell)
      .def("compress_box", &compress_box)
      .def_property_readonly("cell_edges",
                             [](Model &model)
                             {
                               model.require_free();
                               return array_of(model.simulation().particles.cell.edges);
                             })
      .def_property(
          "cell_rate",
          [](Model &model)
          {
            model.require_free();
            return array_of(model.simulation().particles.cell.rate);
          },
          [](Model &model, const py::handle &rate)
          {
            const Work work(model);
            dem::PeriodicCell &cell = model.simulation().particles.cell;
            if (!cell.is_periodic())
              throw ConfigError("there is no periodic cell whose rate could be set");
            const Vec3 wanted = vector_of(rate, "rate of the periodic cell");
            require(wanted.allFinite(), "rate of the periodic cell", wanted.sum(), "finite [m/s]");
            dem::PeriodicCell changed = cell;
            changed.rate = wanted;
            changed.validate();
            dem::require_walls_fit(changed, model.simulation().walls);
            cell = changed;
          });
}

} // namespace bergamo::python
