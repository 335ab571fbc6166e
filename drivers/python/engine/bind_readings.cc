#include "drivers/python/engine/arrays.h"
#include "drivers/python/engine/bindings.h"
#include "drivers/python/engine/model.h"

#include "dem/core/pvd.h"
#include "dem/io/contacts_vtu.h"
#include "dem/io/surface_vtu.h"
#include "dem/io/vtu.h"
#include "dem/measure/contact_list.h"
#include "dem/measure/surface_stress.h"

#include <pybind11/stl.h>

#include <utility>

namespace py = pybind11;

namespace bergamo::python
{
namespace
{

/// Has the forces of the present step made, and then reads with Python's lock.
template <class Read>
auto at_step(Read read)
{
  return [read](Model &model)
  {
    const Work work(model);
    {
      const py::gil_scoped_release unlocked;
      model.simulation().compute_forces();
    }
    return read(std::as_const(model.simulation()));
  };
}

std::vector<dem::TouchingContact> all_contacts(const dem::Simulation &simulation)
{
  std::vector<dem::TouchingContact> all = simulation.contacts.touching(simulation.particles);
  const auto with_walls = simulation.contacts.touching_walls(simulation.particles);
  all.insert(all.end(), with_walls.begin(), with_walls.end());
  return all;
}

/// Arrays by the names of bergamo.Contacts.
py::dict contacts_of(const dem::Simulation &simulation)
{
  const dem::Particles &grains = simulation.particles;
  std::vector<std::int64_t> first, second, wall, feature, law;
  std::vector<Vec3> start, branch, tangential, normal, point;
  std::vector<double> normal_force, overlap, weight;
  for (const dem::TouchingContact &c : all_contacts(simulation))
  {
    first.push_back(grains.id[c.first]);
    second.push_back(c.second == dem::no_grain ? dem::no_grain : grains.id[c.second]);
    wall.push_back(c.wall);
    feature.push_back(c.feature);
    law.push_back(c.law);
    start.push_back(grains.position[c.first]);
    branch.push_back(c.branch);
    tangential.push_back(c.state.weight * c.state.forces.tangential);
    normal.push_back(c.state.normal);
    point.push_back(dem::contact_point(c, grains));
    normal_force.push_back(c.state.weight * c.state.forces.normal);
    overlap.push_back(c.state.overlap);
    weight.push_back(c.state.weight);
  }
  using namespace py::literals;
  return py::dict("first"_a = array_of(first), "second"_a = array_of(second), "start"_a = array_of(start),
                  "branch"_a = array_of(branch), "normal_force"_a = array_of(normal_force),
                  "tangential_force"_a = array_of(tangential), "overlap"_a = array_of(overlap),
                  "direction"_a = array_of(normal), "place"_a = array_of(point),
                  "fields"_a = py::dict("weight"_a = array_of(weight), "wall"_a = array_of(wall),
                                        "feature"_a = array_of(feature), "law"_a = array_of(law)));
}

py::dict energy_of(const dem::Simulation &simulation)
{
  const dem::GrainEnergy e = simulation.energy();
  using namespace py::literals;
  return py::dict("kinetic"_a = e.kinetic, "normal"_a = e.normal, "tangential"_a = e.tangential,
                  "friction_loss"_a = e.friction_loss, "viscous_loss"_a = e.viscous_loss,
                  "curvature_work"_a = e.curvature_work, "search_work"_a = e.search_work,
                  "quadrature_work"_a = e.quadrature_work, "wall_work"_a = e.wall_work,
                  "gravity_work"_a = e.gravity_work, "external_work"_a = e.external_work, "cell_work"_a = e.cell_work,
                  "exchanged"_a = e.exchanged, "step_change"_a = e.step_change, "balance"_a = e.balance());
}

/// Force [N] and moment about the origin [N m] by surface, (s, 6).
py::array loads_of(const dem::Simulation &simulation)
{
  std::vector<std::array<double, 6>> rows;
  for (const dem::SurfaceLoad &load : simulation.surface_loads())
    rows.push_back({load.force.x(), load.force.y(), load.force.z(), load.moment.x(), load.moment.y(), load.moment.z()});
  return array_of(rows);
}

py::array node_forces(Model &model, const std::int32_t surface)
{
  return at_step([surface](const dem::Simulation &s) { return py::array(array_of(s.node_forces(surface))); })(model);
}

void draw_grains(const dem::Simulation &simulation, const std::string &path)
{
  std::vector<double> force;
  for (const Vec3 &f : simulation.particles.force)
    force.push_back(f.norm());
  const dem::GrainField fields[] = {{"resultant_force", force}};
  dem::write_grains_vtu(simulation.particles, fields, path);
}

void draw_surfaces(const dem::Simulation &simulation, const std::string &path)
{
  std::size_t n_features = 0;
  for (const dem::Surface &surface : simulation.surfaces)
    n_features += surface.n_features();
  const auto stresses =
      dem::surface_stress(simulation.surfaces, simulation.contacts.touching_walls(simulation.particles),
                          simulation.contacts.friction_work(n_features));
  dem::write_surfaces_vtu(simulation.surfaces, stresses, path);
}

void draw(Model &model, const std::string &what, const std::string &path)
{
  at_step(
      [&](const dem::Simulation &s)
      {
        if (what == "grains")
          draw_grains(s, path);
        else if (what == "contacts")
          dem::write_contacts_vtu(s.particles, all_contacts(s), path);
        else
          draw_surfaces(s, path);
        return 0;
      })(model);
}

} // namespace

void bind_readings(py::object &object)
{
  py::class_<Model, std::shared_ptr<Model>> model = object;
  model.def("compute_forces", at_step([](const dem::Simulation &) { return py::none(); }))
      .def("contacts", at_step(&contacts_of))
      .def("energy", at_step(&energy_of))
      .def("surface_loads", at_step(&loads_of))
      .def("node_forces", &node_forces)
      .def("cell_stress", at_step([](const dem::Simulation &s) { return array_of(s.cell_stress()); }))
      .def("stable_time_step", at_step([](const dem::Simulation &s) { return s.stable_time_step(); }))
      .def("draw", &draw)
      .def_static("write_pvd", [](const std::string &path, const std::vector<std::pair<double, std::string>> &frames)
                  { write_pvd(path, frames); });
}

} // namespace bergamo::python
