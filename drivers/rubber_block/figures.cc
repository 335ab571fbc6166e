#include "drivers/rubber_block/figures.h"

#include "dem/measure/contact_list.h"

#include <algorithm>

namespace bergamo::driver
{

void BlockFigures::look(const Pull &pull, const RubberBlockParameters &p, const double time)
{
  const Vec3 force = pull.contact_force();
  const ContactPressure &pressure = pull.contact_pressure();
  overlap = std::max(overlap, dem::largest_relative_overlap(pull.sand().contacts, pull.sand().particles));
  if (time >= p.loading_time && time < p.pull_begin())
  {
    ++n_held;
    carried += force[2] / (pull.weight() + pull.top().force());
  }
  if (time < p.pull_begin() + p.start_time)
    return;
  ++n_pulled;
  horizontal -= force[0];
  vertical += force[2];
  pulling += pull.pulling_force();
  mobilized += pressure.mobilized_friction();
  front += pressure.strips().back();
  largest_front = std::max(largest_front, pressure.strips().back());
  largest_face = std::max(largest_face, pressure.largest());
}

void BlockFigures::add_to(Summary &summary, const double top) const
{
  summary.set("carried_before_pull", n_held > 0. ? carried / n_held : 0.);
  if (n_pulled == 0.)
    return;
  summary.set("friction_coefficient", horizontal / vertical);
  summary.set("mobilized_friction", mobilized / n_pulled);
  summary.set("mean_pulling_force_N", pulling / n_pulled, "N");
  summary.set("mean_vertical_force_N", vertical / n_pulled, "N");
  summary.set("front_pressure_over_top_pressure", front / n_pulled / top);
  summary.set("largest_front_pressure_over_top_pressure", largest_front / top);
  summary.set("largest_face_pressure_over_top_pressure", largest_face / top);
}

void BlockFigures::visit(StateVisitor &visit)
{
  visit("figures/n_held", n_held);
  visit("figures/n_pulled", n_pulled);
  visit("figures/carried", carried);
  visit("figures/horizontal", horizontal);
  visit("figures/vertical", vertical);
  visit("figures/pulling", pulling);
  visit("figures/mobilized", mobilized);
  visit("figures/front", front);
  visit("figures/largest_front", largest_front);
  visit("figures/largest_face", largest_face);
  visit("figures/overlap", overlap);
}

} // namespace bergamo::driver
