#include "dem/core/error.h"
#include "dem/geometry/rigid_clump.h"
#include "dem/io/grain_file.h"

#include "tests/temporary_folder.h"

#include <catch2/catch.hpp>

#include <cstdio>
#include <fstream>

using namespace bergamo;
using namespace bergamo::dem;
using Catch::Contains;

namespace
{

MaterialTable two_materials()
{
  MaterialTable materials({Material{}, Material{}});
  materials[1].density = 1000.;
  return materials;
}

GrainsOfFile read(const std::string &name, const std::string &text, const double unit = 1.)
{
  const TemporaryFolder folder;
  std::ofstream(folder / name) << text;
  return read_grains(folder / name, two_materials(), unit);
}

std::string refusal(const std::string &name, const std::string &text)
{
  try
  {
    read(name, text);
  }
  catch (const ConfigError &error)
  {
    CHECK_THAT(error.what(), Contains(name));
    return error.what();
  }
  return "nothing was refused";
}

std::string digits(const double number)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", number);
  return text;
}

const std::string names = "id,x_m,y_m,z_m,qx,qy,qz,qw,a_m,b_m,c_m,exponent_1,exponent_2,material\n";

std::string dump(const std::string &columns, const std::string &rows, const int n = 1)
{
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n";
  text += std::to_string(n);
  text += "\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n-1 1\nITEM: ATOMS ";
  return text.append(columns).append("\n").append(rows);
}

} // namespace

TEST_CASE("grains of a table are those that were written, to the last digit")
{
  const Quaternion turn(Eigen::AngleAxisd(0.7, Vec3(1., 2., -1.).normalized()));
  const Vec3 place(1. / 3., -1e-17, 2. / 7.), half(1e-3 / 3., 2e-3 / 7., 5e-4);
  std::string row = "1";
  for (const double number :
       {place[0], place[1], place[2], turn.x(), turn.y(), turn.z(), turn.w(), half[0], half[1], half[2], 2. / 3., 1.1})
    row += ',' + digits(number);
  const GrainsOfFile file =
      read("one.csv", "# made by hand\n" + names + row + ",1\r\n\n0, 0,0,0, 0,0,0,1, 1e-3,1e-3,1e-3, 1,1, 0\n");
  const Particles &p = file.particles;
  REQUIRE(p.size() == 2);
  CHECK(p.id == std::vector<std::int64_t>{1, 0});
  CHECK(p.position[0] == place);
  CHECK(p.orientation[0].coeffs() == turn.coeffs());
  CHECK(p.parts.shape[0].half_axes == half);
  CHECK(p.parts.shape[0].eps1 == 2. / 3.);
  CHECK(p.parts.shape[0].eps2 == 1.1);
  CHECK(p.parts.material == std::vector<std::int32_t>{1, 0});
  CHECK(p.mass[0] == 1000. * p.volume[0]);
  CHECK(p.mass[1] == 2650. * p.volume[1]);
  p.check(2);
  CHECK(file.box.low[0] == -1e-3);
  CHECK(file.box.high[0] == place[0] + p.bounding_radius[0]);
  CHECK_THAT(file.statement,
             Contains("one.csv: 2 grains with half-axes of 0.000285714 to 0.001 m in [-0.001, 0.333833] x"));
  CHECK_THAT(file.statement, Contains("materials 0 1"));
}

TEST_CASE("quaternions of a table are not made unit once more, which would change their last digits")
{
  std::string text = "x_m,y_m,z_m,qx,qy,qz,qw,radius_m\n";
  std::vector<Quaternion> turns;
  for (int k = 0; k < 100; ++k)
  {
    turns.emplace_back(Eigen::AngleAxisd(0.1 * k, Vec3(1., k, -2.).normalized()));
    text += std::to_string(k) + ",0,0";
    for (const double number : turns.back().coeffs())
      text += ',' + digits(number);
    text += ",1\n";
  }
  const Particles p = read("turned.csv", text).particles;
  bool would_change = false;
  for (int k = 0; k < 100; ++k)
  {
    CHECK(p.orientation[k].coeffs() == turns[k].coeffs());
    would_change = would_change || turns[k].normalized().coeffs() != turns[k].coeffs();
  }
  CHECK(would_change);
}

TEST_CASE("a table of spheres needs places and radii alone; ids that are no count are replaced by one")
{
  const Particles p = read("mm.csv", "radius_m,z_m,y_m,x_m,id,colour\n2,3,2,1,7,red\n1,6,5,4,5,blue\n", 1e-3).particles;
  CHECK(p.id == std::vector<std::int64_t>{0, 1});
  CHECK(p.position[0] == 1e-3 * Vec3(1., 2., 3.));
  CHECK(p.parts.shape[0].is_sphere());
  CHECK(p.parts.shape[0].half_axes[1] == 2e-3);
}

TEST_CASE("lines of one id are a clump, each part where the file has it")
{
  const std::string rows = "4, 0,0,0, 0,0,0.6,0.8, 1,0.5,0.5, 1,1, 0\n"
                           "4, 1,2,0, 0,0,0,1,     0.5,0.5,0.7, 0.8,1, 0\n"
                           "2, 9,9,9, 0,0,0,1,     1,1,1, 1,1, 1\n";
  const Particles p = read("clump.csv", names + rows).particles;
  REQUIRE(p.size() == 2);
  REQUIRE(p.first_part == std::vector<std::int32_t>{0, 2, 3});
  p.check(2);
  CHECK((p.part_position(0) - Vec3::Zero()).norm() < 1e-14);
  CHECK((p.part_position(1) - Vec3(1., 2., 0.)).norm() < 1e-14);
  CHECK(p.part_orientation(0).angularDistance(Quaternion(0.8, 0., 0., 0.6)) < 1e-7);
  CHECK(p.part_orientation(1).angularDistance(Quaternion::Identity()) < 1e-7);
  const double volumes[2]{volume(Superquadric{Vec3(1., 0.5, 0.5), 1., 1.}),
                          volume(Superquadric{Vec3(0.5, 0.5, 0.7), 0.8, 1.})};
  const double share = volumes[1] / (volumes[0] + volumes[1]);
  CHECK((p.position[0] - share * Vec3(1., 2., 0.)).norm() < 1e-9);
}

TEST_CASE("clumps that are alike lie where the file has them, at each size and turn")
{
  ClumpShape shape;
  shape.parts = {{{Vec3(1., 0.5, 0.5), 1., 1.}, Vec3(2., 0., 1.), Quaternion(0.8, 0., 0., 0.6)},
                 {{Vec3(0.5, 0.5, 0.7), 0.8, 1.}, Vec3(2.3, 0.4, 1.1), Quaternion::Identity()}};
  const Quaternion turn(Eigen::AngleAxisd(2., Vec3(1., -2., 0.5).normalized()));
  const auto placed = [&](const ClumpPart &part, const double size) {
    return ClumpPart{part.shape, size * (turn * part.position) + Vec3(7., 8., 9.), turn * part.orientation};
  };
  std::string text = names;
  for (const double size : {1., 1.7, -1.7}) // the last one with another second part
    for (const ClumpPart &part : shape.parts)
    {
      const ClumpPart here = placed(part, std::abs(size));
      const double other = size < 0. && &part != &shape.parts.front() ? 1.01 : 1.;
      text += size == 1. ? "0" : size > 0. ? "1" : "2";
      for (const double number : here.position)
        text += ',' + digits(number);
      for (const double number : here.orientation.coeffs())
        text += ',' + digits(number);
      for (const double number : part.shape.half_axes)
        text += ',' + digits(std::abs(size) * other * number);
      text += ',' + digits(part.shape.eps1) + ',' + digits(part.shape.eps2) + ",0\n";
    }
  const Particles p = read("alike.csv", text).particles;
  REQUIRE(p.size() == 3);
  p.check(2);
  CHECK(p.volume[1] == Approx(std::pow(1.7, 3) * p.volume[0]).epsilon(1e-12));
  CHECK(p.volume[2] > 1.001 * p.volume[1]);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 2; ++k)
    {
      const ClumpPart here = placed(shape.parts[k], i == 0 ? 1. : 1.7);
      CHECK((p.part_position(2 * i + k) - here.position).norm() < 1e-6);
      CHECK(p.part_orientation(2 * i + k).angularDistance(here.orientation) < 1e-6);
    }
  CHECK(p.parts.shape[5].half_axes[2] == Approx(1.7 * 1.01 * 0.7).epsilon(1e-12));
}

TEST_CASE("dumps of LIGGGHTS: blockiness across and along, the scalar of the quaternion first")
{
  const Particles p = read("dump.liggghts", dump("type id x y z vx shapex shapey shapez quat1 quat2 quat3 quat4 "
                                                 "blockiness1 blockiness2",
                                                 "2 1 1 2 3 9 4e-3 2e-3 1e-3 0.8 0 0 0.6 4 8\n"))
                          .particles;
  const Superquadric &shape = p.parts.shape.at(0);
  CHECK(p.position[0] == Vec3(1., 2., 3.));
  CHECK(shape.half_axes == Vec3(4e-3, 2e-3, 1e-3));
  CHECK(shape.eps1 == 0.25);
  CHECK(shape.eps2 == 0.5);
  CHECK(p.orientation[0].coeffs() == Quaternion(0.8, 0., 0., 0.6).coeffs());
  CHECK(p.parts.material[0] == 1);
  // Podlozhnyuk, Pirker & Kloss (2017), eq. 1: (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1.
  const Vec3 point(1e-3, 1.5e-3, 0.7e-3);
  const double across = std::pow(0.25, 8.) + std::pow(0.75, 8.);
  CHECK(inside_outside(shape, point) == Approx(std::pow(across, 4. / 8.) + std::pow(0.7, 4.)).epsilon(1e-14));
}

TEST_CASE("dumps of LAMMPS have diameters; those of the export OVITO's names")
{
  const Particles lammps = read("a.lammpstrj", dump("id type xu yu zu shapex shapey shapez quatw quati quatj quatk",
                                                    "1 1 1 2 3 4 2 1 0.8 0 0 0.6\n"))
                               .particles;
  CHECK(lammps.parts.shape[0].half_axes == Vec3(2., 1., 0.5));
  CHECK(lammps.orientation[0].coeffs() == Quaternion(0.8, 0., 0., 0.6).coeffs());
  const Particles ours =
      read("b.dump", dump("id type x y z Orientation.X Orientation.Y Orientation.Z Orientation.W AsphericalShape.X "
                          "AsphericalShape.Y AsphericalShape.Z SuperquadricRoundness.Phi SuperquadricRoundness.Theta",
                          "1 1 1 2 3 0 0 0.6 0.8 4 2 1 0.5 0.7\n"))
          .particles;
  CHECK(ours.parts.shape[0].half_axes == Vec3(4., 2., 1.));
  CHECK(ours.parts.shape[0].eps1 == 0.5);
  CHECK(ours.parts.shape[0].eps2 == 0.7);
  CHECK(ours.orientation[0].coeffs() == lammps.orientation[0].coeffs());
}

TEST_CASE("what a file of grains cannot mean is refused by line and column")
{
  const std::string good = "0,0,0,0,0,0,0,1,1,1,1,1,1,0\n";
  const auto csv = [&](const std::string &row) { return refusal("a.csv", names + good + row); };
  CHECK_THAT(csv("1,0,0,x,0,0,0,1,1,1,1,1,1,0\n"), Contains("line 3: column 4 (z_m) is 'x': that is no finite number"));
  CHECK_THAT(csv("1,0,0,nan,0,0,0,1,1,1,1,1,1,0\n"), Contains("line 3: column 4"));
  CHECK_THAT(csv("\n# note\n1,0,0,,0,0,0,1,1,1,1,1,1,0\n"), Contains("line 5: column 4 (z_m) is ''"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,1,1,1,1,1,1\n"), Contains("line 3: it has 13 words under 14 columns"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,2,1,1,1,1,1,0\n"), Contains("(qw) is '2': with the other three"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,1,1,-1,1,1,1,0\n"), Contains("column 10 (b_m) is '-1': a length must be positive"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,1,1,1,1,1,2,0\n"), Contains("column 13 (exponent_2) is '2': it must be in (0, 2)"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,1,1,1,1,1,1,2\n"), Contains("column 14 (material) is '2': the materials are 0 to 1"));
  CHECK_THAT(csv("1.5,0,0,0,0,0,0,1,1,1,1,1,1,0\n"), Contains("column 1 (id) is '1.5': that is no whole number"));
  CHECK_THAT(csv("1,0,0,0,0,0,0,1,1,1,1,1,1,0\n" + good), Contains("line 4: the id 0 was given to a grain before"));
  CHECK_THAT(csv("0,0,0,0,0,0,0,1,1,1,1,1,1,1\n"), Contains("line 3: the grain 0 is of material 0 and of 1"));
  CHECK_THAT(refusal("a.csv", "x_m,y_m,radius_m\n"), Contains("line 1: there is no column 'z_m' beside x_m, y_m, z_m"));
  CHECK_THAT(refusal("a.csv", "x_m,y_m,z_m\n"), Contains("no columns for the sizes"));
  CHECK_THAT(refusal("a.csv", "x_m,y_m,z_m,x_m,radius_m\n"), Contains("column 4 is called 'x_m' like one before"));
  CHECK_THAT(refusal("a.csv", names), Contains("there are no grains"));
  CHECK_THAT(refusal("a.csv", ""), Contains("it is empty"));
  CHECK_THAT(refusal("a.dump", "1 2 3\n"), Contains("no line 'ITEM: ATOMS'"));
  CHECK_THAT(refusal("a.dump", dump("id xs ys zs radius", "1 0 0 0 1\n")), Contains("scaled ones, xs, are not read"));
  CHECK_THAT(refusal("a.dump", dump("id x y z c_s[1]", "1 0 0 0 1\n")), Contains("dump_modify colname"));
  CHECK_THAT(refusal("a.dump", dump("id x y z radius", "1 0 0 0 1\n", 2)), Contains("ends after 1 grains of 2"));
  CHECK_THAT(refusal("a.dump", dump("id x y z radius", "1 0 0 0 1\nITEM: TIMESTEP\n1\n")),
             Contains("line 11: behind its 1 grains stands 'ITEM: TIMESTEP'; give a file of one time step"));
  CHECK_THROWS_WITH(read_grains("/no/such.csv", two_materials()), Contains("/no/such.csv"));
  CHECK_THROWS_WITH(read("a.csv", names + good, 0.), Contains("the unit of a file's lengths is 0"));
}

TEST_CASE("clumps by name, in the file's frame")
{
  const TemporaryFolder folder;
  const auto put = [&](const std::string &rows)
  { std::ofstream(folder / "clumps.csv") << "clump,x_m,y_m,z_m,radius_m\n" + rows; };
  put("pair,0,0,0,1\npair,0,0,2,1\nball,0,0,0,3\n");
  const auto clumps = read_clumps(folder / "clumps.csv", 1e-3);
  REQUIRE(clumps.size() == 2);
  REQUIRE(clumps.at("pair").parts.size() == 2);
  CHECK(clumps.at("pair").parts[1].position == Vec3(0., 0., 2e-3));
  CHECK(clumps.at("ball").parts[0].shape.half_axes[0] == 3e-3);
  CHECK(Clump(clumps.at("pair")).volume() == Approx(2. * 4. / 3. * M_PI * 1e-9).epsilon(1e-9));
  put("a,0,0,0,1\nb,0,0,2,1\na,0,0,0,3\n");
  CHECK_THROWS_WITH(read_clumps(folder / "clumps.csv"), Contains("line 4: column 1 (clump) is 'a'"));
}
