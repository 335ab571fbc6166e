#pragma once

#include "dem/geometry/common_normal.h"
#include "dem/geometry/superquadric.h"

#include <random>

/// Pairs of grains for the tests of the contact search.
namespace contact_pairs
{

using namespace bergamo;
using namespace bergamo::dem;

struct Grain
{
  Superquadric shape;
  Vec3 position = Vec3::Zero();
  Quaternion orientation = Quaternion::Identity();

  BodyPose pose() const { return make_pose(shape, position, orientation); }
};

/// Random grains after Wellmann, fig. 3.11 and table 3.1: half-axes uniform in (0.5, 3), exponents by class.
class RandomPairs
{
public:
  RandomPairs(const int seed, const double smallest_exponent, const double largest_exponent)
      : generator(seed), exponent(smallest_exponent, largest_exponent)
  {
  }

  Superquadric shape()
  {
    return {{axis(generator), axis(generator), axis(generator)}, exponent(generator), exponent(generator)};
  }
  Vec3 direction() { return Vec3(normal(generator), normal(generator), normal(generator)).normalized(); }
  Quaternion orientation()
  {
    return Quaternion(normal(generator), normal(generator), normal(generator), normal(generator)).normalized();
  }
  double uniform(const double low, const double high)
  {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }

private:
  std::mt19937_64 generator;
  std::uniform_real_distribution<double> axis{0.5, 3.}, exponent;
  std::normal_distribution<double> normal;
};

/// Puts body 2 so that c is a common normal with the given overlap: p1 - p2 = overlap c.
inline void place(const Grain &body1, Grain &body2, const Vec3 &c, const double overlap)
{
  body2.position = Vec3::Zero();
  const Vec3 p1 = body1.position + support(body1.pose(), c).arm;
  body2.position = p1 - overlap * c - support(body2.pose(), -c).arm;
}

/// h1(c) + h2(-c) - c.(x2 - x1), from its definition.
inline double phi(const BodyPose &a, const BodyPose &b, const Vec3 &c)
{
  return support(a, c).height + support(b, -c).height - c.dot(b.position - a.position);
}

} // namespace contact_pairs
