#include "drivers/pile_installation/installation.h"

#include "coupling/adapter/dealii_adapter.h"
#include "drivers/common/run/joined_start.h"
#include "drivers/common/run/visit_models.h"
#include "drivers/pile_installation/fit_in.h"
#include "drivers/pile_installation/ground_body.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bergamo::driver
{
namespace
{

std::optional<GroundPlan> plan_of(const InstallationParameters &p, const InstallationStart &start)
{
  return p.is_two_scale() ? std::optional(p.plan(start.sand.level)) : std::nullopt;
}

} // namespace

Installation::Installation(const InstallationParameters &p, std::unique_ptr<dem::Simulation> sand,
                           InstallationStart &start)
    : parameters(p), begun(start), plan_(plan_of(p, start)),
      model(std::move(sand), plan_ ? make_ground(p, start, *plan_) : nullptr, p.simulation.time_step)
{
  if (model.body())
  {
    plan_ = plan_->deeper(static_cast<double>(begun.n_growths) * p.mesh.element_size);
    hold_elements();
    join();
    body_steps.emplace(*model.body());
    require_below(body_steps->stable().time_step, p.simulation.time_step);
    displacement_at_start.assign(model.body()->displacement().size(), 0.);
  }
  pile = place_intruder(model.parts(), *model.grains_mover(), p.make_pile(begun.sand.height), "pile");
}

void Installation::hold_elements()
{
  fe::ExplicitBody &body = *model.body();
  for (const unsigned int face : {0u, 1u, 2u, 3u})
    body.prescribe_velocity(face, face / 2);
  floor = body.prescribe_velocity(4u, 2);
}

std::vector<double> Installation::nodal_weight() const
{
  std::vector<double> weight;
  for (const auto &x : model.body()->node_position())
    weight.push_back(plan_->weight_at({x[0], x[1], x[2]}, parameters.weight));
  return weight;
}

void Installation::join()
{
  model.join(parameters.coupling, nodal_weight(), begun.reference_by_id);
}

bool Installation::must_grow() const
{
  // Not at the first step, of which the forces are known already.
  return plan_ && model.body()->n_steps() > 0 && begun.n_growths < parameters.n_growths() &&
         lowest() - plan_->inner_bottom < parameters.growth_distance;
}

/// The overlap goes down by a layer of elements. Below it come the grains that had settled there, each where the
/// elements have taken its place, fitted in there, and with their velocity; what the pile has come near to is of grains
/// alone.
void Installation::grow()
{
  const GroundPlan before = *plan_;
  plan_ = before.deeper(parameters.mesh.element_size);
  ++begun.n_growths;

  const dem::Particles &reserve = begun.reserve;
  const std::vector<Vec3> moved = motion_of_ground(reserve.position);
  const double margin = parameters.beside_block();
  dem::Particles added, about;
  std::vector<Vec3> settled;
  for (std::size_t i = 0; i < reserve.size(); ++i)
  {
    const Vec3 &place = reserve.position[i];
    if (before.holds_grain(place) || !plan_->is_near(place, margin))
      continue;
    const bool is_added = plan_->holds_grain(place);
    dem::Particles &some = is_added ? added : about;
    some.append(reserve, i, reserve.id[i]);
    some.position.back() += moved[i];
    if (is_added)
      settled.push_back(place);
  }
  for (std::size_t i = 0; i < sand().particles.size(); ++i)
    if (sand().particles.position[i][2] < before.outer_bottom + margin)
      about.append(sand().particles, i, sand().particles.id[i]);
  added = fit_in(added, about, sand().walls, parameters.installing());
  const fe::ExplicitBody &body = *model.body();
  added.velocity = coupling::values_at(body, settled, body.velocity());

  model.grains()->add(added);
  begun.place_by_id.insert(begun.place_by_id.end(), settled.begin(), settled.end());
  begun.reference_by_id = model.overlap()->reference_by_id();
  begun.reference_by_id.insert(begun.reference_by_id.end(), settled.begin(), settled.end());
  model.overlap()->move_to({nodal_weight(), begun.reference_by_id});
}

/// Since the start, at places where the ground lay then.
std::vector<Vec3> Installation::motion_of_ground(const std::span<const Vec3> places) const
{
  std::vector<double> moved(body()->displacement().begin(), body()->displacement().end());
  for (std::size_t dof = 0; dof < moved.size(); ++dof)
    moved[dof] -= displacement_at_start[dof];
  return coupling::values_at(*body(), places, moved);
}

void Installation::settle(Progress &progress)
{
  if (!model.overlap())
    return;
  start_at_rest(model, progress);
  const auto displacement = std::as_const(*model.body()).displacement();
  displacement_at_start.assign(displacement.begin(), displacement.end());
  model.grains()->reset_accounts();
}

void Installation::compute(const double time)
{
  const double step = parameters.simulation.time_step;
  if (must_grow())
    grow();
  if (parameters.drive == PileDrive::speed)
    pile.mover->body().guide().velocity[2] = -parameters.speed_at(time + 0.5 * step);
  model.compute_forces();
  if (parameters.drive == PileDrive::force)
  {
    applied_force = parameters.force_at(time);
    pile.mover->body().add_force({0., 0., -applied_force}, pile.mover->body().centre());
  }
  if (body_steps)
    body_steps->require_stable(step);
  model.kick();
}

double Installation::head_force() const
{
  return parameters.drive == PileDrive::speed ? -pile.mover->body().guide_force()[2] : applied_force;
}

double Installation::pile_work() const
{
  return model.grains()->surfaces[pile.parts.surface].work;
}

double Installation::bottom_force() const
{
  return floor ? -model.body()->reaction(*floor) : model.grains()->walls[bottom_wall].force[2];
}

double Installation::largest_grain_motion() const
{
  double largest = 0.;
  const dem::Particles &p = sand().particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    largest = std::max(largest, (p.position[i] - begun.place_by_id[p.id[i]]).norm());
  return largest;
}

double Installation::largest_element_motion() const
{
  double largest = 0.;
  for (std::size_t dof = 0; dof < displacement_at_start.size(); dof += 3)
  {
    double squares = 0.;
    for (std::size_t d = dof; d < dof + 3; ++d)
      squares += std::pow(body()->displacement()[d] - displacement_at_start[d], 2);
    largest = std::max(largest, std::sqrt(squares));
  }
  return largest;
}

double Installation::unbalanced() const
{
  const dem::Particles &p = sand().particles;
  double resultant = 0., contact = 0.;
  std::size_t n_contacts = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    Vec3 force = p.force[i] + p.weight[i] * p.mass[i] * sand().parameters().gravity;
    if (!p.external_force.empty())
      force += p.external_force[i];
    resultant += force.norm() / p.weight[i];
  }
  for (const auto &touching : {sand().contacts.touching(p), sand().contacts.touching_walls(p)})
    for (const dem::TouchingContact &c : touching)
    {
      contact += std::hypot(c.state.forces.normal, c.state.forces.tangential.norm());
      ++n_contacts;
    }
  return contact > 0. ? (resultant / static_cast<double>(p.size())) / (contact / static_cast<double>(n_contacts)) : 0.;
}

void Installation::look_at_rotation(Progress &progress)
{
  if (model.body())
    rotation.look(*model.body(), progress);
}

void Installation::visit(StateVisitor &visit)
{
  for (const auto &[name, values] : pile.mover->body().state())
    visit("pile/" + name, values);
  rotation.visit(visit);
  if (!model.body())
    return;
  visit_body(visit, *model.body());
  visit("overlap", *model.overlap());
  visit_steps(visit, *body_steps);
  visit("displacement_at_start", displacement_at_start);
}

} // namespace bergamo::driver
