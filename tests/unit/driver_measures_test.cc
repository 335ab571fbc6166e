#include "coupling/adapter/model_energy.h"
#include "dem/force/surface_loads.h"
#include "dem/loading/cell_measures.h"
#include "drivers/common/run/energy_residual.h"
#include "drivers/common/run/measured_columns.h"
#include "drivers/common/run/model_pictures.h"
#include "drivers/common/run/snapshot.h"
#include "fe_dealii/explicit_body.h"
#include "fe_dealii/mesh/box_mesh.h"
#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <map>

using namespace bergamo;
using namespace bergamo::driver;
using Catch::Matchers::Contains;

namespace
{

std::map<std::string, double> values_of(const std::vector<Column> &columns)
{
  std::map<std::string, double> values;
  for (const Column &column : columns)
    values[column.name] = column.value();
  return values;
}

} // namespace

TEST_CASE("the energy's residual counts from the first sample, over the largest work")
{
  EnergyResidual residual;
  CHECK(residual.relative() == 0);
  CHECK(residual.add(8, 0) == 0);
  CHECK(residual.relative() == 0); // no work yet
  CHECK(residual.add(7.5, -4) == -0.5);
  CHECK(residual.present() == -0.5);
  CHECK(residual.add(8.25, 1) == 0.25);
  CHECK(residual.relative() == 0.125);
}

TEST_CASE("the energy's residual goes on after a restart")
{
  TemporaryFolder folder;
  const Snapshot snapshot(folder / "s.h5", "test", "");
  EnergyResidual before, after;
  before.add(8, 0);
  before.add(7.5, 4);
  snapshot.write([&](StateVisitor &v) { before.visit(v); });
  snapshot.read([&](StateVisitor &v) { after.visit(v); });
  CHECK(after.relative() == 0.125);
  CHECK(after.add(9, 2) == 1);
  CHECK(after.relative() == 0.25);
}

TEST_CASE("columns show what they are named for, as it changes")
{
  dem::CellMeasures cell;
  const std::vector<Column> columns = columns_of(cell);
  cell.strain = Vec3(-0.5, 1., 3.);
  cell.assembly.stress << 1., 2., 3., 4., 5., 6., 7., 8., 9.;
  cell.assembly.coordination = {.mean = 10., .mechanical = 11., .without_rattlers = 12.};
  cell.largest_overlap = 13.;
  cell.energy.normal = 14.;
  cell.energy.tangential = 15.;
  cell.energy.cell_work = 16.;
  auto values = values_of(columns);
  CHECK(values["strain_z"] == 3.);
  CHECK(values["volumetric_strain"] == 3.); // 0.5 * 2 * 4 - 1
  CHECK(values["stress_zz_Pa"] == 9.);
  CHECK(values["stress_xz_Pa"] == 5.); // the mean of 3 and 7
  CHECK(values["mechanical_coordination_number"] == 11.);
  CHECK(values["coordination_number_without_rattlers"] == 12.);
  CHECK(values["max_overlap_over_radius"] == 13.);
  CHECK(values["energy_grains_elastic_J"] == 29.);
  CHECK(values["energy_cell_work_J"] == 16.);
}

TEST_CASE("the columns of a model's energies add up to its balance")
{
  coupling::ModelEnergy energy;
  double power = 1.; // of two each, so that no two sums are the same
  for (double *part :
       {&energy.kinetic, &energy.grains_elastic, &energy.continuum_elastic, &energy.coupling, &energy.friction_loss,
        &energy.viscous_loss, &energy.plastic_loss, &energy.wall_work, &energy.gravity_work, &energy.curvature_work})
    *part = power *= 2.;
  double sum = 0.;
  for (const auto &[name, value] : values_of(columns_of(energy)))
    sum += name.find("work") == std::string::npos ? value : -value;
  CHECK(sum == energy.balance());
}

TEST_CASE("the columns of grains' energies add up to their balance")
{
  dem::GrainEnergy energy;
  double power = 1.;
  for (double *part :
       {&energy.kinetic, &energy.normal, &energy.tangential, &energy.friction_loss, &energy.viscous_loss,
        &energy.curvature_work, &energy.search_work, &energy.quadrature_work, &energy.wall_work, &energy.gravity_work})
    *part = power *= 2.;
  energy.exchanged = -1.;
  double sum = 0.;
  for (const auto &[name, value] : values_of(columns_of(energy)))
    sum += name.find("work") == std::string::npos && name != "energy_exchanged_J" ? value : -value;
  CHECK(sum == energy.balance());
}

TEST_CASE("each surface has its force and moment, and none once it is gone")
{
  std::vector<dem::SurfaceLoad> loads{{Vec3(1., 2., 3.), Vec3(4., 5., 6.)}, {Vec3(7., 8., 9.), Vec3(10., 11., 12.)}};
  const std::vector<Column> columns = columns_of(loads, {"wall", "floor"});
  CHECK(columns.size() == 12);
  auto values = values_of(columns);
  CHECK(values["wall_force_x_N"] == 1.);
  CHECK(values["wall_moment_z_Nm"] == 6.);
  CHECK(values["floor_force_y_N"] == 8.);
  CHECK(values["floor_moment_x_Nm"] == 10.);
  loads.pop_back();
  values = values_of(columns);
  CHECK(values["wall_force_y_N"] == 2.);
  CHECK(values["floor_force_y_N"] == 0.);
}

TEST_CASE("further columns stand to the right")
{
  Table table{{{"a", [] { return 1.; }}}};
  table.add({{"b", [] { return 2.; }}, {"c", [] { return 3.; }}});
  CHECK(table.names() == std::vector<std::string>{"a", "b", "c"});
  CHECK(table.row() == std::vector<double>{1., 2., 3.});
}

TEST_CASE("pictures are of the models that are there")
{
  CHECK(pictures_of(nullptr, nullptr).empty());
  dem::Particles particles;
  particles.add(dem::Superquadric{Vec3::Ones(), 1., 1.}, 1., Vec3::Zero(), Quaternion::Identity());
  const dem::Simulation grains({}, std::move(particles), {});
  const std::vector<Picture> pictures = pictures_of(&grains, nullptr);
  REQUIRE(pictures.size() == 1);
  CHECK(pictures[0].first == "grains");
  TemporaryFolder folder;
  pictures[0].second(folder / "grains.vtu");
  CHECK_THAT(content_of(folder / "grains.vtu"), Contains("weight") && Contains("resultant_force"));
  const fe::ExplicitBody body = fe::make_box_body({{0, 0, 0}, {1, 1, 1}, {1, 1, 1}}, {});
  const std::vector<Picture> alone = pictures_of(nullptr, &body), both = pictures_of(&grains, &body);
  REQUIRE(alone.size() == 1);
  CHECK(alone[0].first == "continuum");
  REQUIRE(both.size() == 2);
  CHECK(both[1].first == "continuum");
}
