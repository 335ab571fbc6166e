#include "dem/force/kinds/feature_motion.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// What a step makes of a contact whose grain and feature turn together, as one rigid body.
struct Together
{
  double normal_error, frame_error, displacement, wear;
};

Together turn_together(const double is_face, const double is_edge, const double time_step)
{
  const Vec3 spin(30., -20., 45.), normal = Vec3(1., -2., 3.).normalized();
  const TangentFrame frame = tangent_frame(normal);
  ContactState<double> s = ContactState<double>::begin();
  s.normal = normal;
  s.axis = frame.col(0);
  s.point = Vec3(2e-4, -1e-4, 9e-4);
  s.overlap = 1e-6;
  s.radii1 = {8e-4, 5e-4, 1e-4};
  s.wear1 = {3., 2.};
  s.twist_wear = 1.;
  s.radii2.r11 = 1e3;
  FeatureMotion<double> motion;
  motion.spin = motion.feature_spin = spin;
  motion.time_step = time_step;
  motion.velocity = spin.cross(s.point); // of the feature at the contact, minus the grain's centre
  motion.edge = (frame.col(0) + 2. * frame.col(1)).normalized();
  motion.is_face = is_face;
  motion.is_edge = is_edge;
  const ContactTurn<double> turn = motion.turn(s, frame);
  const TurnedFrame<double> turned(normal, frame, turn);
  const Mat3 rotation = Eigen::AngleAxisd(spin.norm() * time_step, spin.normalized()).toRotationMatrix();
  return {(turned.normal - rotation * normal).norm(), (turned.axis - rotation * s.axis).norm(),
          std::hypot(turn.motion.approach, turn.motion.sliding.norm()), turn.wear};
}

} // namespace

TEST_CASE("a contact turns with a grain and a feature that turn together, and sees no motion", "[surface]")
{
  const double is_face = GENERATE(1., 0.), is_edge = is_face > 0. ? 0. : GENERATE(1., 0.);
  CAPTURE(is_face, is_edge);
  constexpr double time_step = 1e-4, angle = 57.66 * time_step, arm = 1e-3;
  const Together whole = turn_together(is_face, is_edge, time_step),
                 half = turn_together(is_face, is_edge, 0.5 * time_step);
  // The frame's turn has an error of third order in the angle; what the contact sees of the motion is rounding.
  CHECK(whole.normal_error < std::pow(angle, 3));
  CHECK(whole.frame_error < std::pow(angle, 3));
  CHECK(half.normal_error < 0.15 * whole.normal_error);
  CHECK(whole.displacement < 1e-12 * angle * arm);
  CHECK(whole.wear < 1e-2 * angle); // none of its budget
}
