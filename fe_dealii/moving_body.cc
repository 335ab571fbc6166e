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
