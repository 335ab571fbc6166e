// Random pairs of a grain and a triangle, slivers among them, from a hundredth of the grain's size to a hundred times
// it, touching by 1e-5 of a half-axis and more on any feature. Where the grain is in front, find_surface_places() must
// give one place where they touch and none where they do not, and no direction may part them by less: directions are
// searched at random, independently of it.
//   surface_pairs [--runs N] [--seed N] [--hard]       ends with status 1 where any pair is wrong
// Shapes have exponents in [0.5, 1.3], half-axes up to 1 : 5 and overlaps below a hundredth; hard ones [0.3, 1.6],
// 1 : 10 and a twentieth: those may have several least depths, of which one is found, see ARCHITECTURE.md.

#include "tests/surfaces.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>

using namespace bergamo;
using namespace bergamo::dem;
using namespace bergamo::dem::test;

namespace
{

struct Class
{
  double least_exponent, most_exponent, slenderness, deepest;
};

constexpr Class common{0.5, 1.3, 5., 0.01}, hard{0.3, 1.6, 10., 0.05};

class Pairs
{
public:
  Pairs(const Class &of, const unsigned seed) : of(of), random(seed) {}

  void look_at_one()
  {
    const Superquadric shape = draw_shape();
    const std::array<Vec3, 3> corner = draw_triangle();
    const auto &[a, b, c] = corner;
    const Vec3 normal = (b - a).cross(c - a).normalized();
    Vec3 direction = draw_orientation(random) * Vec3::UnitX();
    if (direction.dot(normal) < 0.)
      direction = -direction;
    BodyPose body = make_pose(shape, Vec3::Zero(), draw_orientation(random));
    const double depth = std::pow(10., -5. + (std::log10(of.deepest) + 5.) * share());
    const double u = share(), v = share() * (1. - u);
    const Vec3 touched = share() < 0.3 ? a : Vec3(u * a + v * b + (1. - u - v) * c);
    body.position = touched - support(body, Vec3(-direction)).arm - depth * direction;
    if (normal.dot(body.position - a) <= 0.)
      return; // behind the surface
    const test::Surface triangle{{a, b, c}, SurfaceTopology({{0, 1, 2}}, 3)};
    const std::vector<SurfacePlace> places = find_surface_places(body, triangle.view(), triangle.all_faces());
    const auto depth_along = [&](const Vec3 &d) {
      return std::max({d.dot(a), d.dot(b), d.dot(c)}) + support(body, Vec3(-d)).height - d.dot(body.position);
    };

    Vec3 best = direction;
    double least = depth_along(direction);
    const auto try_along = [&](const Vec3 &d)
    {
      if (const double here = depth_along(d.normalized()); here < least)
      {
        least = here;
        best = d.normalized();
      }
    };
    try_along(normal);
    for (const SurfacePlace &place : places)
      try_along(place.normal);
    for (double reach = 0.3; reach > 1e-7; reach *= 0.6)
      for (int n = 0; n < 12; ++n)
        try_along(best + reach * (draw_orientation(random) * Vec3::UnitX()));
    if (least > of.deepest)
      return;
    constexpr double rounding = 1e-9;
    if (least <= rounding)
      n_wrong += !places.empty() && places[0].overlap > rounding;
    else
    {
      ++n_touching;
      const bool is_right = places.size() == 1 && places[0].index == 1 && least > places[0].overlap - rounding &&
                            std::abs(depth_along(places[0].normal) - places[0].overlap) < rounding;
      n_wrong += !is_right;
      if (places.size() == 1)
        ++n_on[static_cast<int>(places[0].feature)];
    }
  }

  long n_touching = 0, n_wrong = 0;
  std::array<long, 3> n_on{}; ///< by feature

private:
  double share() { return std::uniform_real_distribution<double>(0., 1.)(random); }

  Superquadric draw_shape()
  {
    const double slender = std::pow(of.slenderness, share());
    Superquadric shape;
    shape.half_axes = Vec3(1., std::pow(slender, share()), std::pow(slender, share()));
    shape.eps1 = of.least_exponent + (of.most_exponent - of.least_exponent) * share();
    shape.eps2 = of.least_exponent + (of.most_exponent - of.least_exponent) * share();
    return shape;
  }

  std::array<Vec3, 3> draw_triangle()
  {
    const double size = std::pow(10., -2. + 4. * share());
    const auto corner = [&] { return Vec3(size * Vec3(share() - 0.5, share() - 0.5, share() - 0.5)); };
    const Vec3 a = corner(), b = corner();
    Vec3 c = corner();
    if (share() < 0.3) // a sliver
      c = a + (b - a) * share() + 1e-4 * size * Vec3(share(), share(), share());
    return {a, b, c};
  }

  Class of;
  std::mt19937_64 random;
};

} // namespace

int main(int argc, char **argv)
{
  long n_runs = 1000000;
  unsigned seed = 1;
  bool is_hard = false;
  CLI::App app("Contacts of random grains and triangles against an independent search.", "surface_pairs");
  app.add_option("--runs", n_runs, "Pairs (default: 1000000)")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "Of the random numbers (default: 1)");
  app.add_flag("--hard", is_hard, "Pointed, boxy and slender shapes, deeper overlaps");
  CLI11_PARSE(app, argc, argv);
  Pairs pairs(is_hard ? hard : common, seed);
  for (long n = 0; n < n_runs; ++n)
    pairs.look_at_one();
  std::printf("%ld pairs, %ld touching (%ld on the face, %ld on an edge, %ld on a vertex): %ld wrong\n", n_runs,
              pairs.n_touching, pairs.n_on[0], pairs.n_on[1], pairs.n_on[2], pairs.n_wrong);
  return pairs.n_wrong > 0 || pairs.n_touching == 0;
}
