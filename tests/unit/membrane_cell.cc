// What the triaxial test knows of its membrane: the volume between it and the plates, and the pressure around it.

#include "dem/loading/piston.h"
#include "drivers/membrane_triaxial/lateral_pressure.h"
#include "drivers/membrane_triaxial/membrane.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

using namespace bergamo;
using namespace bergamo::driver;

namespace
{

constexpr double radius = 0.02, height = 0.05;

/// Area of a section over the square of its radius.
double unit_section(const MembraneParameters &p)
{
  return 0.5 * p.n_around * std::sin(2. * std::numbers::pi / p.n_around);
}

/// Moves the nodes: the distance from the axis grows by a factor of the height, heights by another one.
void deform(fe::MovingBody &membrane, const std::function<double(double)> &wider, const double longer)
{
  for (std::size_t node = 0; node < membrane.n_nodes(); ++node)
  {
    const auto &x = membrane.node_position()[node];
    for (int i = 0; i < 2; ++i)
      membrane.displacement()[3 * node + i] = (wider(x[2]) - 1.) * x[i];
    membrane.displacement()[3 * node + 2] = (longer - 1.) * x[2];
  }
}

} // namespace

TEST_CASE("the volume in a membrane is that of a prism, and of a stack of frusta where it bulges")
{
  const MembraneParameters p;
  const auto membrane = make_membrane(p, {radius, height});
  const MembraneShape shape(p, *membrane, {radius, height});
  const double section = unit_section(p) * radius * radius;
  CHECK(shape.volume(height) == Approx(section * height).epsilon(1e-13));
  const std::vector<double> radii = shape.radii();
  CHECK(radii.size() == p.n_high + 1);
  for (const double of_ring : radii)
    CHECK(of_ring == Approx(radius).epsilon(1e-13));

  const double longer = 0.8; // plates approach one another, rims keep their width
  const auto wider = [](const double z) { return 1. + 0.3 * (1. - std::pow(2. * z / height, 2)); };
  deform(*membrane, wider, longer);
  double expected = 0.;
  for (unsigned int k = 0; k < p.n_high; ++k)
  {
    const auto factor = [&](const unsigned int ring)
    { return wider(height * (static_cast<double>(ring) / p.n_high - 0.5)); };
    const double below = factor(k), above = factor(k + 1);
    expected += longer * height / p.n_high * section * (below * below + below * above + above * above) / 3.;
  }
  CHECK(shape.volume(longer * height) == Approx(expected).epsilon(1e-13));
  CHECK(shape.radii()[p.n_high / 2] == Approx(1.3 * radius).epsilon(1e-13));
}

TEST_CASE("a lateral pressure pushes inwards and does the work of the volume that it takes")
{
  const MembraneParameters p;
  auto made = make_membrane(p, {radius, height});
  const fe::Surface faces = fe::membrane_surface(made->dof_handler());
  coupling::BodyMover mover(std::move(made));
  fe::MovingBody &membrane = mover.body();
  LateralPressure load(mover, faces);
  constexpr double pressure = 1e5;
  load.set(pressure);
  load.apply();
  double inwards = 0.;
  for (std::size_t node = 0; node < membrane.n_nodes(); ++node)
    for (int i = 0; i < 2; ++i)
      inwards -= membrane.external_force()[3 * node + i] * membrane.node_position()[node][i];
  CHECK(inwards == Approx(2. * pressure * unit_section(p) * radius * radius * height).epsilon(1e-12));
  CHECK(load.work() == 0.);

  // The volume is quadratic in the width, for which the trapezoidal rule is exact.
  deform(
      membrane, [](double) { return 0.9; }, 1.);
  load.apply();
  load.apply(); // asked again, nothing changes
  CHECK(load.work() == Approx(pressure * (1. - 0.81) * unit_section(p) * radius * radius * height).epsilon(1e-12));
}

TEST_CASE("a piston comes to the speed at which its dashpot bears the push, and to no more than its fastest")
{
  dem::Piston piston{.mass = 0.1, .push = 2., .impedance = 50., .fastest = 1.};
  double speed = 0.;
  for (int step = 0; step < 1000; ++step)
    speed = piston.speed_after(speed, 1e-3);
  CHECK(speed == Approx(0.2).epsilon(1e-9)); // push over a fifth of the impedance
  piston.impedance = 1.;
  for (int step = 0; step < 1000; ++step)
    speed = piston.speed_after(speed, 1e-3);
  CHECK(speed == 1.);
  CHECK(dem::Piston{.mass = 0.1, .push = 2., .fastest = 1.}.speed_after(0., 1e-3) == Approx(0.02).epsilon(1e-14));
}
