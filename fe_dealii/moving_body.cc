#include "fe_dealii/moving_body.h"

#include "dem/core/error.h"
#include "dem/core/parallel.h"
#include "fe_dealii/element/largest_eigenvalue.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace bergamo::fe
{
namespace
{

// Sums over dofs are taken in blocks of this many nodes, then over the blocks in order: the same on any thread count.
constexpr std::size_t block_nodes = 512;
// Below this, waking the threads costs more than they save.
constexpr std::size_t few_elements = 256, few_nodes = 256;
constexpr std::size_t block_elements = 32; // in one virtual call

} // namespace

void MassForces::validate(const std::string &body) const
{
  for (int i = 0; i < 3; ++i)
    if (!std::isfinite(gravity[i]))
      reject(body, ": gravity component ", i, " = ", gravity[i], " m/s^2 is not finite; give a number");
  if (!(damping >= 0) || !std::isfinite(damping))
    reject(body, ": damping = ", damping, " 1/s is not allowed; give zero or a positive number");
}

MovingBody::MovingBody(std::string name, std::vector<std::array<double, 3>> node_position,
                       std::unique_ptr<ElementGroup> elements, const MassForces &forces, const double wanted_time_step)
    : name_(std::move(name)), forces_(forces), wanted_time_step_(wanted_time_step),
      node_position_(std::move(node_position)), elements_(std::move(elements))
{
  const std::span<const unsigned int> nodes = elements_->nodes();
  slots_ = {n_nodes(), [&](const auto &put)
            {
              for (std::size_t place = 0; place < nodes.size(); ++place)
                put(nodes[place], static_cast<unsigned int>(place));
            }};

  const std::size_t n_dofs = 3 * n_nodes();
  for (std::vector<double> *vector : {&displacement_, &velocity_, &internal_force_, &external_force_, &reaction_force_,
                                      &mass_, &displacement_of_stress_})
    vector->assign(n_dofs, 0.);
  constraint_of_dof_.assign(n_dofs, -1);
  gather_mass();
}

MovingBody::MovingBody(MovingBody &&) noexcept = default;
MovingBody::~MovingBody() = default;

void MovingBody::gather_mass()
{
  progress_.has_forces = 0; // elements of other masses have other forces
  scale_mass();
  mass_.assign(3 * n_nodes(), 0.);
  gravitational_mass_.assign(n_nodes(), 0.);
  std::vector<double> inertia(elements_->nodes_per_element()), gravitational(inertia.size());
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    elements_->lumped_mass(e, inertia.data());
    elements_->gravitational_mass(e, gravitational.data());
    for (std::size_t v = 0; v < inertia.size(); ++v)
    {
      const std::size_t node = element_nodes(e)[v];
      for (std::size_t i = 0; i < 3; ++i)
        mass_[3 * node + i] += mass_factor(e) * inertia[v];
      gravitational_mass_[node] += gravitational[v];
    }
  }
}

void MovingBody::exchange(const std::function<void()> &change)
{
  const bool is_booked = n_steps() > 0;
  if (is_booked)
    compute_internal_force();
  const double before = is_booked ? present_energy() : 0;
  change();
  gather_mass();
  if (!is_booked)
    return;
  compute_internal_force();
  ledger_.exchanged += present_energy() - before;
}

/// Elastic at the last forces, kinetic at the half step before, less what the elements do on the nodes from there to
/// here: the energy of the step with these elements, but for what does not depend on them [J].
double MovingBody::present_energy() const
{
  double sum = elements_->elastic_energy();
  for (std::size_t dof = 0; dof < mass_.size(); ++dof)
    sum += 0.5 * velocity_[dof] * (mass_[dof] * velocity_[dof] - ledger_.last_step * internal_force_[dof]);
  return sum;
}

void MovingBody::scale_mass()
{
  mass_factor_.clear();
  mass_scaling_ = {};
  if (!(wanted_time_step_ > 0))
    return;
  // The inertia that makes 2/sqrt(λ) the wanted step; the last bit of a square root must not take it below.
  constexpr double rounding = 1e-12;
  const double bearable = 4 / (wanted_time_step_ * wanted_time_step_);
  std::vector<double> factor(n_elements());
  parallel_for(factor.size(),
               [&](const std::size_t e)
               {
                 const double eigenvalue = largest_eigenvalue(*elements_, e, displacement_.data());
                 factor[e] = std::max(1., eigenvalue / bearable * (1 + rounding));
               });
  double true_mass = 0;
  std::vector<double> mass(elements_->nodes_per_element());
  for (std::size_t e = 0; e < factor.size(); ++e)
  {
    elements_->lumped_mass(e, mass.data());
    const double of_element = std::accumulate(mass.begin(), mass.end(), 0.);
    true_mass += of_element;
    if (!(factor[e] > 1))
      continue;
    mass_scaling_.added_mass += (factor[e] - 1) * of_element;
    ++mass_scaling_.n_elements;
    mass_scaling_.largest_factor = std::max(mass_scaling_.largest_factor, factor[e]);
  }
  mass_scaling_.share = mass_scaling_.added_mass / true_mass;
  if (mass_scaling_.n_elements > 0)
    mass_factor_ = std::move(factor);
}

bool MovingBody::has_moved() const
{
  return !std::equal(displacement_.begin(), displacement_.end(), displacement_of_stress_.begin());
}

void MovingBody::compute_internal_force()
{
  if (progress_.has_forces != 0 && !has_moved())
    return;
  progress_.has_forces = 0;
  const std::size_t n_places = elements_->n_places();
  const std::size_t n_blocks = (n_places + block_elements - 1) / block_elements;
  const double *const now = displacement_.data();
  double *const before = displacement_of_stress_.data();
  const std::span<const double> element_force = elements_->forces();
  Collected<std::size_t> inverted, endless; // elements, nodes
  parallel_ranges(n_blocks, few_elements / 2 / block_elements,
                  [&](const std::size_t part, const std::size_t first, const std::size_t last)
                  {
                    for (std::size_t block = first; block < last; ++block)
                    {
                      const std::size_t begin = block * block_elements;
                      const std::size_t end = std::min(n_places, begin + block_elements);
                      if (const auto element = elements_->compute_forces(begin, end, now, before))
                        inverted.of(part).push_back(*element);
                    }
                  });
  // Each node sums its elements in their order: no race, and the same bits whatever the threads.
  parallel_ranges(n_nodes(), few_nodes,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t node = begin; node < end; ++node)
                    {
                      double force[3] = {0, 0, 0};
                      for (const unsigned int slot : slots_[node])
                        for (int i = 0; i < 3; ++i)
                          force[i] += element_force[3 * std::size_t(slot) + i];
                      for (std::size_t i = 0; i < 3; ++i)
                      {
                        internal_force_[3 * node + i] = force[i];
                        before[3 * node + i] = now[3 * node + i];
                      }
                      if (!std::isfinite(force[0] + force[1] + force[2]))
                        endless.of(part).push_back(node);
                    }
                  });
  if (const std::vector<std::size_t> all = inverted.all(); !all.empty())
    report_failure(*std::min_element(all.begin(), all.end()));
  if (!endless.all().empty())
    report_endless_forces();
  progress_.has_forces = 1;
}

/// A kick between two steps.
struct MovingBody::Kick
{
  double before, after, time; // the steps, and over which the forces act [s]
  double half_damping;        // of a velocity, over half of the time [-]

  /// A node of absent elements alone has no mass and stays.
  double velocity_after(const double old, const double force, const double mass) const
  {
    if (mass == 0)
      return 0;
    return ((1 - half_damping) * old + time * force / mass) / (1 + half_damping);
  }
};

/// A node with dashpots after a kick.
struct MovingBody::Braked
{
  Dashpots::Vector velocity{}, drag{}; // [m/s], [N]
};

/// What nodes add to the accounts by a kick.
struct MovingBody::KickSums
{
  double kinetic = 0;
  Work before, after; // over the half steps around it
};

void MovingBody::Work::add(const Work &part)
{
  external += part.external;
  gravity += part.gravity;
  boundary += part.boundary;
  viscous += part.viscous;
  radiated += part.radiated;
  step_change += part.step_change;
}

void MovingBody::kick(const double dt)
{
  require(dt > 0 && std::isfinite(dt), name_ + ": the time step", dt, "a positive number of seconds");
  if (progress_.is_kicked != 0)
    throw RunError(name_ + ": kicked twice in one step; let a drift follow each kick");
  if (!dashpots_.empty())
    let_go_of_dashpots();
  const Kick kick{ledger_.last_step > 0 ? ledger_.last_step : dt, dt, kick_time(dt),
                  0.5 * forces_.damping * kick_time(dt)};
  kick_images(kick);
  const std::size_t n_blocks = (n_nodes() + block_nodes - 1) / block_nodes;
  std::vector<KickSums> sums(n_blocks);
  parallel_ranges(n_blocks, 1,
                  [&](std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t block = begin; block < end; ++block)
                      sums[block] =
                          kick_nodes(kick, block * block_nodes, std::min(n_nodes(), (block + 1) * block_nodes));
                  });
  KickSums total;
  for (const KickSums &block : sums)
  {
    total.kinetic += block.kinetic;
    total.before.add(block.before);
    total.after.add(block.after);
  }
  if (!std::isfinite(total.kinetic + total.after.external))
    report_endless_motion();
  ledger_.here = ledger_.ahead;
  ledger_.here.add(total.before);
  ledger_.ahead = ledger_.here;
  ledger_.ahead.add(total.after);
  ledger_.kinetic = total.kinetic;
  if (ledger_.last_step == 0)
    ledger_.initial =
        ledger_.kinetic + elements_->elastic_energy() + elements_->dissipated_energy() + elements_->stiffness_loss();
  ledger_.last_step = dt;
  progress_.is_kicked = 1;
}

MovingBody::KickSums MovingBody::kick_nodes(const Kick &kick, const std::size_t begin, const std::size_t end)
{
  const double half_step_before = ledger_.last_step > 0 ? 0.5 * kick.before : 0, half_step_after = 0.5 * kick.after;
  // Of v⁺ − v⁻, to what it would be between two steps like the one before, and like the one after; none where the steps
  // are alike.
  const double to_before = (kick.before - kick.time) / kick.time, to_after = (kick.time - kick.after) / kick.time;
  const bool changes = kick.before != kick.after;
  KickSums sums;
  for (std::size_t node = begin; node < end; ++node)
  {
    const bool is_braked = dashpots_.has(node), is_imaged = images_.has(node);
    const Braked braked = is_braked ? brake(kick, node) : Braked{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t dof = 3 * node + i;
      const double mass = mass_[dof], old = velocity_[dof];
      const double external = external_force_[dof], weight = gravitational_mass_[node] * forces_.gravity[i];
      const double held = is_braked ? held_force(dof) : 0, drag = braked.drag[i];
      const double force = external + weight - internal_force_[dof];
      const int constraint = constraint_of_dof_[dof];
      double fresh, damping, reaction = 0;
      if (constraint < 0 && !is_imaged)
      {
        fresh = is_braked ? braked.velocity[i] : kick.velocity_after(old, force, mass);
        damping = 0.5 * forces_.damping * mass * (old + fresh);
      }
      else
      {
        fresh = is_imaged ? imaged_velocity_[dof] : constraint_velocity_[constraint];
        damping = 0.5 * forces_.damping * mass * (old + fresh);
        reaction = mass * (fresh - old) / kick.time + damping + drag - force;
      }
      velocity_[dof] = fresh;
      reaction_force_[dof] = reaction;
      if (changes)
      {
        const double kinetic = 0.5 * mass * old * (fresh + to_before * (fresh - old));
        sums.kinetic += kinetic;
        sums.after.step_change += 0.5 * mass * (old + to_after * (fresh - old)) * fresh - kinetic;
      }
      else
        sums.kinetic += 0.5 * mass * old * fresh;
      const auto add = [&](Work &work, const double path)
      {
        work.external += external * path;
        work.gravity += weight * path;
        work.boundary += (reaction + held) * path;
        work.viscous += damping * path;
        work.radiated += drag * path;
      };
      add(sums.before, half_step_before * old);
      add(sums.after, half_step_after * fresh);
    }
  }
  return sums;
}

MovingBody::Braked MovingBody::brake(const Kick &kick, const std::size_t node) const
{
  Dashpots::Kick of_node;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t dof = 3 * node + i;
    const double force = external_force_[dof] + weight(dof) + held_force(dof) - internal_force_[dof];
    const int constraint = constraint_of_dof_[dof];
    of_node.old[i] = velocity_[dof];
    of_node.is_free[i] = constraint < 0;
    of_node.without[i] =
        constraint < 0 ? kick.velocity_after(velocity_[dof], force, mass_[dof]) : constraint_velocity_[constraint];
    of_node.inertia[i] = mass_[dof] * (1 + kick.half_damping) / kick.time;
  }
  Braked braked;
  braked.velocity = dashpots_.velocity_after(node, of_node);
  Dashpots::Vector mean;
  for (int i = 0; i < 3; ++i)
    mean[i] = 0.5 * (of_node.old[i] + braked.velocity[i]);
  braked.drag = dashpots_.drag(node, mean);
  return braked;
}

void MovingBody::add_dashpots(const std::span<const Dashpot> dashpots)
{
  if (progress_.n_steps > 0 || progress_.is_kicked != 0)
    reject(name_, ": dashpots are added after ", n_steps(), " steps; add them before the first");
  for (const Dashpot &dashpot : dashpots)
    if (dashpot.node >= n_nodes() || dashpot.element >= n_elements())
      reject(name_, ": a dashpot at node ", dashpot.node, " of element ", dashpot.element, ", but there are only ",
             n_nodes(), " nodes and ", n_elements(), " elements");
  for (const Dashpot &dashpot : dashpots)
    if (images_.has(dashpot.node))
      reject(name_, ": a dashpot at node ", dashpot.node, " of a face that repeats itself; put dashpots elsewhere");
  dashpots_.add(dashpots, n_nodes());
  held_force_.assign(3 * n_nodes(), 0.);
  progress_.is_rested = 0;
  if (!hold_)
    hold_ = prescribe_velocity(std::span<const unsigned int>(), 0);
  for (const unsigned int node : dashpots_.nodes())
    for (std::size_t i = 0; i < 3; ++i)
      if (int &constraint = constraint_of_dof_[3 * std::size_t(node) + i]; constraint < 0)
      {
        constraint = static_cast<int>(hold_->place());
        constraint_dofs_[hold_->place()].push_back(3 * node + i);
      }
}

void MovingBody::let_go_of_dashpots()
{
  if (progress_.n_steps == 0 && progress_.is_rested == 0)
    throw RunError(name_ + ": its first step begins with quiet boundaries that do not know what they hold; call "
                           "find_equilibrium(), or rest() where it is at rest as it is, before");
  if (hold_)
    for (const unsigned int dof : constraint_dofs_[hold_->place()])
      if (is_held_by_dashpots(dof))
        constraint_of_dof_[dof] = -1;
  hold_.reset();
  std::vector<double> factor(dashpots_.elements().size());
  parallel_for(factor.size(),
               [&](const std::size_t k)
               {
                 const std::size_t element = dashpots_.elements()[k];
                 factor[k] = std::sqrt(elements_->stiffness_factor(element) * mass_factor(element));
               });
  dashpots_.set_viscosity(factor);
}

std::array<double, 3> MovingBody::drag(const std::size_t node) const
{
  if (!dashpots_.has(node))
    return {};
  return dashpots_.drag(node, {velocity_[3 * node], velocity_[3 * node + 1], velocity_[3 * node + 2]});
}

void MovingBody::rest()
{
  for (std::size_t dof = 0; dof < velocity_.size(); ++dof)
  {
    velocity_[dof] = 0;
    const double force = external_force_[dof] + weight(dof) - internal_force_[dof];
    reaction_force_[dof] = constraint_of_dof_[dof] < 0 && !images_.has(dof / 3) ? 0 : -force;
    if (is_held_by_dashpots(dof))
      held_force_[dof] = -force;
  }
  ledger_ = {};
  progress_.is_kicked = 0;
  progress_.is_rested = 1;
}

void MovingBody::drift(const double dt)
{
  if (progress_.is_kicked == 0 || dt != ledger_.last_step)
  {
    std::ostringstream message;
    message << name_ << ": a drift over " << dt << " s without a kick for it; kick with the same time step first";
    throw RunError(message.str());
  }
  parallel_ranges(displacement_.size(), 3 * few_nodes,
                  [&](std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t dof = begin; dof < end; ++dof)
                      displacement_[dof] += dt * velocity_[dof];
                  });
  progress_.is_kicked = 0;
  ++progress_.n_steps;
  progress_.time += dt;
}

MovingBody::Constraint MovingBody::prescribe_velocity(const unsigned int boundary_id, const unsigned int component,
                                                      const double velocity)
{
  return prescribe_velocity(boundary_nodes(boundary_id), component, velocity);
}

MovingBody::Constraint MovingBody::prescribe_velocity(const std::span<const unsigned int> nodes,
                                                      const unsigned int component, const double velocity)
{
  if (component > 2)
    reject(name_, ": component ", component, " of a prescribed velocity is not allowed; choose 0, 1 or 2 for x, y, z");
  for (const unsigned int node : nodes)
    if (node >= n_nodes())
      reject(name_, ": a velocity is prescribed at node ", node, ", but there are only ", n_nodes(), " nodes");
  const Constraint constraint(constraint_velocity_.size());
  auto &dofs = constraint_dofs_.emplace_back();
  const auto prescribe = [&](const unsigned int node)
  {
    const std::size_t dof = 3 * std::size_t(node) + component;
    if (constraint_of_dof_[dof] >= 0 && !is_held_by_dashpots(dof))
      return;
    constraint_of_dof_[dof] = static_cast<int>(constraint.place());
    dofs.push_back(dof);
  };
  for (const unsigned int node : nodes)
    if (!images_.has(node))
      prescribe(node);
  for (const NodeImages::Group &group : images_.groups())
    if (std::find_first_of(nodes.begin(), nodes.end(), group.nodes.begin(), group.nodes.end()) != nodes.end())
      std::for_each(group.nodes.begin(), group.nodes.end(), prescribe);
  constraint_velocity_.push_back(velocity);
  return constraint;
}

void MovingBody::repeat(const std::array<bool, 3> is_periodic)
{
  if (!constraint_velocity_.empty() || !dashpots_.empty())
    reject(name_, ": it is to repeat itself, but velocities are prescribed or dashpots put already; let it repeat "
                  "itself first");
  images_ = NodeImages(node_position_, is_periodic);
  imaged_velocity_.assign(velocity_.size(), 0.);
}

void MovingBody::set_face_velocity(const std::array<double, 3> &velocity)
{
  for (std::size_t d = 0; d < 3; ++d)
    face_velocity_[d] = images_.is_periodic()[d] ? velocity[d] : 0.;
}

std::array<double, 3> MovingBody::face_force(const std::size_t direction) const
{
  std::array<double, 3> sum{};
  for (const NodeImages::Group &group : images_.groups())
    for (std::size_t k = 0; k < group.nodes.size(); ++k)
      for (std::size_t i = 0; i < 3; ++i)
        sum[i] += group.shift[k][direction] * reaction_force_[3 * std::size_t(group.nodes[k]) + i];
  return sum;
}

/// What images get by a kick. Their forces on one another are reactions, whose work on both is that of the faces.
void MovingBody::kick_images(const Kick &kick)
{
  for (const NodeImages::Group &group : images_.groups())
    for (std::size_t i = 0; i < 3; ++i)
    {
      double mass = 0, momentum = 0, pushed = 0, force = 0; // momenta of what they had, and of what faces give
      for (std::size_t k = 0; k < group.nodes.size(); ++k)
      {
        const std::size_t node = group.nodes[k], dof = 3 * node + i;
        mass += mass_[dof];
        momentum += mass_[dof] * velocity_[dof];
        pushed += mass_[dof] * group.shift[k][i] * face_velocity_[i];
        force += external_force_[dof] + weight(dof) - internal_force_[dof];
      }
      const int constraint = constraint_of_dof_[3 * std::size_t(group.nodes[0]) + i];
      const double first = constraint >= 0 ? constraint_velocity_[constraint]
                           : mass == 0     ? 0
                                           : kick.velocity_after(momentum / mass, force, mass) - pushed / mass;
      for (std::size_t k = 0; k < group.nodes.size(); ++k)
        imaged_velocity_[3 * std::size_t(group.nodes[k]) + i] = first + group.shift[k][i] * face_velocity_[i];
    }
}

void MovingBody::make_rigid(const std::span<const unsigned int> nodes)
{
  std::vector<bool> is_among(n_nodes(), false);
  for (const unsigned int node : nodes)
    is_among[node] = true;
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    const std::span<const unsigned int> own = element_nodes(e);
    if (std::all_of(own.begin(), own.end(), [&](const unsigned int node) { return is_among[node]; }))
      elements_->make_rigid(e);
  }
  progress_.has_forces = 0;
}

double MovingBody::reaction(const Constraint constraint) const
{
  double sum = 0;
  for (const unsigned int dof : constraint_dofs_[constraint.place()])
    sum += reaction_force_[dof];
  return sum;
}

Stress MovingBody::average_stress() const
{
  Stress result{};
  double volume = 0;
  for (std::size_t e = 0; e < n_elements(); ++e)
  {
    const Stress stress = state_of(e).stress;
    for (int i = 0; i < 6; ++i)
      result[i] += elements_->volume(e) * stress[i];
    volume += elements_->volume(e);
  }
  for (double &component : result)
    component /= volume;
  return result;
}

BodyEnergy MovingBody::energy() const
{
  BodyEnergy energy;
  energy.kinetic = ledger_.kinetic;
  energy.elastic = elements_->elastic_energy();
  energy.plastic_dissipation = elements_->dissipated_energy();
  energy.stiffness_loss = elements_->stiffness_loss();
  energy.viscous_dissipation = ledger_.here.viscous;
  energy.radiated = ledger_.here.radiated;
  energy.boundary_work = ledger_.here.boundary;
  energy.gravity_work = ledger_.here.gravity;
  energy.external_work = ledger_.here.external;
  energy.step_change = ledger_.here.step_change;
  energy.exchanged = ledger_.exchanged;
  energy.initial =
      ledger_.last_step > 0 ? ledger_.initial : energy.elastic + energy.plastic_dissipation + energy.stiffness_loss;
  return energy;
}

double MovingBody::max_velocity() const
{
  double greatest = 0;
  for (std::size_t node = 0; node < n_nodes(); ++node)
  {
    const double x = velocity_[3 * node], y = velocity_[3 * node + 1], z = velocity_[3 * node + 2];
    greatest = std::max(greatest, x * x + y * y + z * z);
  }
  return std::sqrt(greatest);
}

bool MovingBody::is_finite() const
{
  const auto finite = [](const double x) { return std::isfinite(x); };
  return std::all_of(velocity_.begin(), velocity_.end(), finite) &&
         std::all_of(displacement_.begin(), displacement_.end(), finite);
}

std::vector<std::pair<std::string, std::span<double>>> MovingBody::state()
{
  static_assert(sizeof(Ledger) % sizeof(double) == 0 && sizeof(Progress) % sizeof(double) == 0);
  std::vector<std::pair<std::string, std::span<double>>> result{
      {"displacement", displacement_},
      {"displacement_of_stress", displacement_of_stress_},
      {"velocity", velocity_},
      {"internal_force", internal_force_},
      {"external_force", external_force_},
      {"reaction_force", reaction_force_},
      {"constraint_velocity", {constraint_velocity_.data(), constraint_velocity_.size()}},
      {"ledger", {reinterpret_cast<double *>(&ledger_), sizeof(Ledger) / sizeof(double)}},
      {"progress", {reinterpret_cast<double *>(&progress_), sizeof(Progress) / sizeof(double)}}};
  if (!dashpots_.empty())
    result.push_back({"held_force", held_force_});
  if (!images_.empty())
    result.push_back({"face_velocity", face_velocity_});
  for (auto &view : elements_->state())
    result.push_back(std::move(view));
  return result;
}

} // namespace bergamo::fe
