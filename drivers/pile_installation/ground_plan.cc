#include "drivers/pile_installation/ground_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bergamo::driver
{
namespace
{

/// Planes that divide a way evenly, without its start.
void add_even(std::vector<double> &planes, const double to, const double step)
{
  const double from = planes.back();
  const int n = std::max(1, static_cast<int>(std::lround((to - from) / step)));
  for (int k = 1; k < n; ++k)
    planes.push_back(from + (to - from) * k / n);
  planes.push_back(to);
}

/// Planes of steps that shrink towards an edge, from the far end up to it.
std::vector<double> shrinking(const double far_end, const double edge, const GroundMesh &mesh)
{
  std::vector<double> planes;
  const std::vector<double> outwards = fe::graded_planes(edge - far_end, mesh.element_size, mesh.growth);
  for (auto place = outwards.rbegin(); place != outwards.rend(); ++place)
    planes.push_back(edge - *place);
  return planes;
}

} // namespace

GroundPlan GroundPlan::deeper(const double by) const
{
  GroundPlan plan = *this;
  plan.inner_bottom -= by;
  plan.outer_bottom -= by;
  return plan;
}

bool GroundPlan::holds_grain(const Vec3 &centre) const
{
  return is_near(centre, 0.);
}

bool GroundPlan::is_near(const Vec3 &centre, const double margin) const
{
  return std::abs(centre[0]) < outer_half_width + margin && centre[2] > outer_bottom - margin;
}

double GroundPlan::weight_at(const Vec3 &place, const coupling::WeightShape shape) const
{
  const double from_side = (outer_half_width - std::abs(place[0])) / (outer_half_width - inner_half_width),
               from_bottom = (place[2] - outer_bottom) / (inner_bottom - outer_bottom);
  const double share = std::min(from_side, from_bottom), nearest = std::round(share);
  constexpr double rounding = 1e-9;
  return coupling::weight_at(shape, std::abs(share - nearest) < rounding ? nearest : share);
}

fe::PitMeshParameters mesh_of(const GroundPlan &plan, const GroundMesh &mesh)
{
  const double overlap_step = (plan.outer_half_width - plan.inner_half_width) / mesh.overlap_layers;
  std::vector<double> x = shrinking(-plan.half_width, -plan.outer_half_width, mesh);
  const std::vector<double> left = x;
  add_even(x, -plan.inner_half_width, overlap_step);
  add_even(x, plan.inner_half_width, mesh.element_size);
  add_even(x, plan.outer_half_width, overlap_step);
  for (auto place = left.rbegin() + 1; place != left.rend(); ++place)
    x.push_back(-*place);

  std::vector<double> z = shrinking(plan.bottom, plan.deepest_bottom, mesh);
  if (plan.outer_bottom > plan.deepest_bottom)
    add_even(z, plan.outer_bottom, mesh.element_size);
  add_even(z, plan.inner_bottom, overlap_step);
  add_even(z, plan.top, mesh.element_size);

  std::vector<double> y{-plan.half_breadth};
  add_even(y, plan.half_breadth, 2. * plan.half_breadth / mesh.layers_across);

  constexpr double far = std::numeric_limits<double>::max();
  return {{x, y, z}, {-plan.inner_half_width, -far, plan.inner_bottom}, {plan.inner_half_width, far, far}};
}

} // namespace bergamo::driver
