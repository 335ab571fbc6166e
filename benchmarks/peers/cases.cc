#include "benchmarks/peers/cases.h"

#include "benchmarks/peers/settled_beads.h"
#include "benchmarks/peers/vessels.h"
#include "dem/measure/mixing.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace bergamo::benchmark
{
namespace
{

constexpr double bead_radius = 2e-3;                           // [m]
constexpr double flow_softening = 400., shot_softening = 100.; // see begin()
constexpr double end_of_fall = 0.02;                           // below the orifice, where beads are taken out [m]
constexpr double dense_fraction = 0.6;

double bead_volume()
{
  return 4. / 3. * std::numbers::pi * std::pow(bead_radius, 3);
}

void set_duration(BulkCase &bulk, const double seconds, const int n_samples)
{
  bulk.n_samples = n_samples;
  bulk.steps_between_samples = std::max<std::int64_t>(1, std::llround(seconds / n_samples / bulk.parameters.time_step));
}

/// Height of a column of a cross-section that n beads need before they fall [m].
double loose_height(const int n_beads, const double area)
{
  return n_beads * bead_volume() / loose_fraction / area;
}

/// @param softening of the beads; their overlaps stay a hundredth of them. Hertz's step grows with its root.
BulkCase begin(const std::string &name, const double published_step, const double softening)
{
  BulkCase bulk;
  bulk.name = name;
  bulk.parameters = bulk_parameters(softening);
  bulk.parameters.time_step = published_step * std::sqrt(softening);
  return bulk;
}

} // namespace

BulkCase silo_case(const CaseOptions &options)
{
  BulkCase bulk =
      begin("silo", options.silo_material == material_1 ? 1.5e-6 : 2e-6, options.is_soft ? flow_softening : 1.);
  const int n_beads = options.full ? 20000 : 1500;
  Silo silo;
  silo.radius = options.full ? 0.05 : 0.025;
  silo.orifice_radius = options.has_large_orifice ? 0.02 : 0.015;
  silo.height = silo.cone_height() + loose_height(n_beads, std::numbers::pi * silo.radius * silo.radius);
  bulk.vessel = silo.surface();
  bulk.vessel.material = steel;
  const std::int32_t material = options.silo_material;
  fill(bulk, {.n_beads = n_beads,
              .radius = bead_radius,
              .space = silo.space(),
              .stoppers = {dem::PlaneWall{}}, // in the orifice
              .material_at = [material](const Vec3 &) { return material; }});
  set_duration(bulk, options.full ? 5. : 0.5, options.full ? 250 : 50);
  bulk.outlet = -end_of_fall;
  bulk.developed = 0.05;
  bulk.measure = {"beads above the orifice", "",
                  [](const Frame &frame)
                  {
                    return static_cast<double>(std::count_if(frame.position.begin(), frame.position.end(),
                                                             [](const Vec3 &x) { return x.z() > 0.; }));
                  }};
  return bulk;
}

BulkCase drum_case(const CaseOptions &options)
{
  BulkCase bulk = begin("drum", 1.5e-6, options.is_soft ? flow_softening : 1.);
  const int n_beads = options.full ? 15000 : 1000;
  constexpr double filling = 0.45; // of the drum's volume, by beads and their pores
  Drum drum;
  drum.radius = options.full ? 0.1 : 0.03;
  drum.width = n_beads * bead_volume() / dense_fraction / filling / (std::numbers::pi * drum.radius * drum.radius);
  bulk.vessel = drum.surface();
  bulk.vessel.material = steel;
  bulk.vessel_spin = 2.;
  fill(bulk, {.n_beads = n_beads,
              .radius = bead_radius,
              .space = drum.space(),
              .stoppers = {},
              .material_at = [](const Vec3 &x) { return x.x() < 0. ? material_1 : material_2; }});
  set_duration(bulk, options.full ? 5. : 1.2, options.full ? 250 : 60);
  bulk.developed = 0.25;
  std::vector<std::uint8_t> is_first;
  for (const std::int32_t m : bulk.beads.parts.material)
    is_first.push_back(m == material_1);
  constexpr double cell = 6. * bead_radius; // some 16 beads
  bulk.measure = {"mixing, Lacey's index", "",
                  [is_first](const Frame &frame)
                  {
                    std::vector<std::uint8_t> of_frame;
                    for (const std::int64_t id : frame.id)
                      of_frame.push_back(is_first[id]);
                    return dem::lacey_index(frame.position, of_frame, cell);
                  }};
  return bulk;
}

BulkCase penetration_case(const CaseOptions &options)
{
  BulkCase bulk = begin("penetration", 5e-7, options.is_soft ? shot_softening : 1.);
  const int n_beads = options.full ? options.n_penetrated : 2500;
  OpenBox box;
  box.width = options.full ? 0.1 * std::cbrt(n_beads / 25000.) : 0.048; // deeper alike
  box.height = loose_height(n_beads, box.width * box.width);
  bulk.vessel = box.surface();
  bulk.vessel.material = steel;
  fill(bulk, {.n_beads = n_beads,
              .radius = bead_radius,
              .space = box.space(),
              .stoppers = {},
              .material_at = [](const Vec3 &) { return material_1; }});
  const double ball_radius = options.full ? 0.01 : 0.007, speed = options.full ? 5. : 2.;
  const auto highest = std::max_element(bulk.beads.position.begin(), bulk.beads.position.end(),
                                        [](const Vec3 &a, const Vec3 &b) { return a.z() < b.z(); });
  const double surface = highest->z() + bead_radius;
  dem::Superquadric ball;
  ball.half_axes.setConstant(ball_radius);
  bulk.beads.add(ball, bulk.parameters.materials[steel].density, Vec3(0., 0., surface + ball_radius),
                 Quaternion::Identity(), steel);
  bulk.beads.velocity.back() = Vec3(0., 0., -speed);
  set_duration(bulk, options.full ? 0.1 : 0.05, 100);
  bulk.developed = 0.003;
  bulk.only_bead = n_beads;
  bulk.measure = {"depth of the ball's lowest point", "mm", [surface, ball_radius](const Frame &frame) {
                    return 1e3 * (surface - (frame.position.front().z() - ball_radius));
                  }};
  return bulk;
}

} // namespace bergamo::benchmark
