#include "benchmarks/engine_figures.h"

#include <type_traits>

namespace bergamo::benchmark
{

std::size_t n_touching(const dem::Simulation &simulation)
{
  return simulation.contacts.n_touching();
}

double mean_relative_overlap(const dem::Simulation &simulation)
{
  double overlaps = 0., distances = 0.;
  for (const dem::TouchingContact &contact : simulation.contacts.touching(simulation.particles))
  {
    overlaps += contact.state.overlap;
    distances += contact.branch.norm();
  }
  return distances > 0. ? overlaps / distances : 0.;
}

namespace
{

/// Bytes a contact: its state read, what follow() changes written, and its bodies; see dem/force/follow.h.
template <class State>
std::size_t contact_bytes()
{
  constexpr bool is_sphere = std::is_same_v<State, dem::SphereContactState<double>>;
  // Normal, axis, point, forces, overlap and budget; or forces and overlap.
  constexpr std::size_t n_written = is_sphere ? 4 + 1 : 3 + 3 + 3 + 3 + 1 + 1;
  return sizeof(State) + n_written * sizeof(double) + 4 * sizeof(std::int32_t) + sizeof(dem::Image);
}

} // namespace

StepBytes step_bytes(const dem::Simulation &simulation)
{
  constexpr std::size_t vector = sizeof(Vec3), number = sizeof(double);
  const std::size_t n = simulation.particles.size();
  StepBytes bytes;
  dem::Contacts::for_each_set(simulation.contacts,
                              [&]<class Kind>(const dem::ContactSet<Kind> &set, std::int32_t)
                              {
                                bytes.contacts += set.n_touching() * contact_bytes<typename Kind::State>();
                                bytes.candidates += set.size() * (number + 2 * sizeof(std::int32_t));
                              });
  const std::size_t seen = 3 * vector + number;                           // place, velocity, spin; path
  const std::size_t summed = 2 * sizeof(dem::BodyLoad)                    // written and read, once at least
                             + 2 * vector;                                // force and torque written
  const std::size_t state = 5 * vector + 2 * number + sizeof(Quaternion); // all that moves, read and written
  const std::size_t constant = 3 * vector + 3 * number; // force, torque, inertia; mass, weight, radius
  bytes.grains = n * (seen + summed + 2 * state + constant);
  return bytes;
}

std::vector<Phase> phase_times(const dem::Simulation &simulation)
{
  const PhaseTimes &t = simulation.times;
  return {{"neighbours", t.neighbours}, {"contacts", t.contacts},   {"screening", t.screening},
          {"searches", t.searches},     {"summation", t.summation}, {"motion", t.motion}};
}

} // namespace bergamo::benchmark
