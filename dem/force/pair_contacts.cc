#include "dem/force/pair_contacts.h"

#include "dem/core/parallel.h"
#include "dem/force/follow.h"
#include "dem/force/follow_spheres.h"
#include "dem/force/search_contacts.h"

#include <algorithm>
#include <limits>

namespace bergamo::dem
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A pair of spheres whose contact begins in this step.
struct NewSphereContact
{
  std::int32_t pair, slot;
  Resultant resultant;
};

/// Two grains, the second one as an image of itself.
struct Grains
{
  std::int32_t first, second;
  Image image;
};

PairMotion<double> motion_of(const Particles &p, const Grains &g, const double time_step)
{
  return {p, [=](int) { return g.first; }, [=](int) { return g.second; }, [=](int) { return g.image; }, time_step};
}

SphereGeometry<double> sphere_geometry(const Particles &p, const Grains &g)
{
  const double radius1 = p.bounding_radius[g.first], radius2 = p.bounding_radius[g.second];
  return {0.5 * p.branch(g.first, g.second, g.image), radius1 + radius2, radius1 - radius2};
}

double sphere_weight(const Particles &p, const std::int32_t i, const std::int32_t j)
{
  const double fraction = p.bounding_radius[i] / (p.bounding_radius[i] + p.bounding_radius[j]);
  return p.weight[i] + fraction * (p.weight[j] - p.weight[i]);
}

/// The state of two spheres about to touch.
SphereContactState<double> begin_spheres(const Particles &p, const std::int32_t i, const std::int32_t j,
                                         const ContactLaw &law)
{
  const double radius1 = p.bounding_radius[i], radius2 = p.bounding_radius[j];
  const double curvature = 0.5 * (1. / radius1 + 1. / radius2);
  const HertzMindlin<double> stiffness = hertz_mindlin(curvature, curvature, law.elastic);
  SphereContactState<double> s = SphereContactState<double>::idle();
  s.root_overlap = 0.;
  s.normal_stiffness = stiffness.normal;
  s.tangential_stiffness = stiffness.tangential_major;
  s.reduced_mass = 1. / (1. / p.mass[i] + 1. / p.mass[j]);
  s.weight = sphere_weight(p, i, j);
  s.radius_sum = radius1 + radius2;
  s.radius_difference = radius1 - radius2;
  return s;
}

} // namespace

/// Pairs apart that may touch by now.
struct PairContacts::Screened
{
  Collected<std::int32_t> candidates;  ///< to be searched
  Collected<std::int32_t> new_spheres; ///< touch
};

PairContacts::Screened PairContacts::screen(const Particles &p)
{
  Screened screened;
  const auto look_at = [&](const std::int32_t pair, const std::size_t part)
  {
    const std::int32_t i = list.first[pair], j = list.second[pair];
    if (!are_spheres(i, j))
    {
      screened.candidates.of(part).push_back(pair);
      return;
    }
    const double overlap = sphere_geometry(p, {i, j, list.image[pair]}).overlap;
    if (overlap > 0.)
      screened.new_spheres.of(part).push_back(pair);
    else
      rest_until[pair] = p.motion[i] + p.motion[j] + p.cell.motion - overlap;
  };
  const auto motion_of_pair = [&](const std::size_t pair)
  { return p.motion[list.first[pair]] + p.motion[list.second[pair]] + p.cell.motion; };
  const std::size_t n_packs = list.size() / pack_width;
  parallel_ranges(n_packs, 64,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t pack = begin; pack < end; ++pack)
                    {
                      const std::size_t pair = pack * pack_width;
                      const Pack motion =
                          math::generate<Pack>([&](const int lane) { return motion_of_pair(pair + lane); });
                      const math::Mask<Pack> is_at_rest = motion < math::load(&rest_until[pair]);
                      if (!math::any(!is_at_rest))
                        continue;
                      for (int lane = 0; lane < pack_width; ++lane)
                        if (!math::lane(is_at_rest, lane))
                          look_at(static_cast<std::int32_t>(pair + lane), part);
                    }
                  });
  for (std::size_t pair = n_packs * pack_width; pair < list.size(); ++pair)
    if (!(motion_of_pair(pair) < rest_until[pair]))
      look_at(static_cast<std::int32_t>(pair), most_parts() - 1);
  return screened;
}

/// A contact that a search found and that did not touch last step.
struct PairContacts::NewContact
{
  ContactSearch search;
  ContactState<double> state;
};

/// What searches change, in their order; contacts that stay are in their slots, their loads in due_loads.
struct PairContacts::Found
{
  Collected<ContactSearch> ended;
  Collected<NewContact> begun;
};

/// Searches the contacts that are due, and then the candidates among the pairs apart.
PairContacts::Found PairContacts::search(const std::vector<std::int32_t> &due_slots,
                                         const std::vector<std::int32_t> &candidates, const SearchContext &context)
{
  const Particles &p = context.particles;
  const std::size_t n = due_slots.size() + candidates.size(), n_packs = (n + pack_width - 1) / pack_width;
  const auto search_of = [&](const std::size_t k) -> ContactSearch
  {
    if (k < due_slots.size())
    {
      const std::int32_t s = due_slots[k];
      return {grains.pair[s], grains.first[s], grains.second[s], grains.image[s], s};
    }
    const std::int32_t pair = candidates[k - due_slots.size()];
    return {pair, list.first[pair], list.second[pair], list.image[pair], apart};
  };
  due_loads.resize(due_slots.size());
  Found found;
  Collected<std::int64_t> undecided;
  std::vector<ContactLosses> pack_losses(n_packs);
  parallel_ranges(n_packs, 1,
                  [&](const std::size_t part, const std::size_t begin, const std::size_t end)
                  {
                    std::vector<ContactSearch> searches;
                    std::vector<BegunContact> begun;
                    for (std::size_t pack = begin; pack < end; ++pack)
                    {
                      const std::size_t from = pack * pack_width, to = std::min(from + pack_width, n);
                      searches.clear();
                      begun.clear();
                      for (std::size_t k = from; k < to; ++k)
                        searches.push_back(search_of(k));
                      search_contacts(searches, 0, to - from, context, pack_losses[pack], begun);
                      for (std::size_t k = from; k < to; ++k)
                      {
                        const ContactSearch &s = searches[k - from];
                        if (s.is_undecided)
                          undecided.of(part).push_back(s.pair);
                        if (k < due_slots.size())
                          due_loads[k] = {s.resultant, s.is_touching};
                        if (s.is_touching)
                          continue;
                        rest_until[s.pair] = p.motion[s.first] + p.motion[s.second] + p.cell.motion + s.gap;
                        if (s.slot != apart)
                          found.ended.of(part).push_back(s);
                      }
                      for (const BegunContact &c : begun)
                        found.begun.of(part).push_back({searches[c.search], c.state});
                    }
                  });
  for (const ContactLosses &lost : pack_losses)
    losses += lost;
  n_searches += static_cast<std::int64_t>(n);
  undecided.for_each([&](const std::int64_t) { ++n_undecided; });
  return found;
}

/// Adds what the searches of due contacts that stay have given, each chunk by one thread. @param due_slots ascending
void PairContacts::add_due_loads(const Particles &p, const std::vector<std::int32_t> &due_slots)
{
  const auto first_of_chunk = [&](const std::size_t chunk)
  {
    return std::lower_bound(due_slots.begin(), due_slots.end(), static_cast<std::int32_t>(chunk * slots_per_chunk)) -
           due_slots.begin();
  };
  parallel_ranges(grains.n_chunks(), 1,
                  [&](const std::size_t, const std::size_t begin, const std::size_t end)
                  {
                    const auto last = first_of_chunk(end);
                    for (auto k = first_of_chunk(begin); k < last; ++k)
                      if (due_loads[k].is_touching)
                        add_load_of(p, grains.pair[due_slots[k]], due_loads[k].resultant);
                  });
}

void PairContacts::compute(const Particles &p, const ContactLaw &law, const ContactParameters &parameters,
                           const double time_step, PhaseTimes &times)
{
  Stopwatch watch;
  list_bodies(p.size());

  // 1. Touching contacts.
  const auto due = follow_all(grains, grain_loads, losses,
                              [&](const std::size_t block, Losses<Pack> &lost)
                              { return follow_block(grains, grain_loads, block, p, law, time_step, lost); });
  const auto ended_spheres = follow_all(spheres, sphere_loads, losses,
                                        [&](const std::size_t block, Losses<Pack> &lost) {
                                          return follow_block(spheres, sphere_loads, block, p, law, time_step, lost);
                                        });
  watch.lap(times.contacts);

  // 2. Pairs apart.
  const Screened screened = screen(p);
  watch.lap(times.screening);

  // 3. Searches.
  const std::vector<std::int32_t> due_slots = due.all();
  const Found found =
      search(due_slots, screened.candidates.all(), {p, law, parameters, time_step, grains, separating_direction});

  // Contacts that began or ended take and leave their slots one by one.
  found.ended.for_each(
      [&](const ContactSearch &s)
      {
        const ContactState<double> state = grains.get(s.slot);
        const PairMotion<double> motion = motion_of(p, {s.first, s.second, s.image}, time_step);
        losses += separate(state, state.normal, motion.displacement(state.point));
        grains.remove(s.slot);
        slot[s.pair] = apart;
      });
  found.begun.for_each(
      [&](const NewContact &c)
      {
        const ContactSearch &s = c.search;
        slot[s.pair] = grains.add({s.pair, s.first, s.second, s.image}, c.state, slot_near(s.pair));
        grain_loads.take(slot[s.pair], s.first, s.second);
        rest_until[s.pair] = infinity;
      });
  ended_spheres.for_each(
      [&](const std::int32_t s)
      {
        const std::int32_t i = spheres.first[s], j = spheres.second[s], pair = spheres.pair[s];
        const Grains two{i, j, spheres.image[s]};
        const SphereGeometry<double> g = sphere_geometry(p, two);
        losses += separate(spheres.get(s), g.normal, motion_of(p, two, time_step).displacement(g.point));
        spheres.remove(s);
        slot[pair] = apart;
        rest_until[pair] = p.motion[i] + p.motion[j] + p.cell.motion - g.overlap;
      });
  std::vector<NewSphereContact> new_spheres;
  screened.new_spheres.for_each(
      [&](const std::int32_t pair)
      {
        const std::int32_t i = list.first[pair], j = list.second[pair];
        SphereContactState<double> state = begin_spheres(p, i, j, law);
        const FollowedSpheres<double> f = follow(state, motion_of(p, {i, j, list.image[pair]}, time_step), law, losses);
        slot[pair] = spheres.add({pair, i, j, list.image[pair]}, state, slot_near(pair));
        sphere_loads.take(slot[pair], i, j);
        rest_until[pair] = infinity;
        new_spheres.push_back({pair, slot[pair], {f.force, f.torque1, f.torque2}});
      });

  list_bodies(p.size());
  add_due_loads(p, due_slots);
  found.begun.for_each([&](const NewContact &c) { add_load_of(p, c.search.pair, c.search.resultant); });
  for (const NewSphereContact &s : new_spheres)
    add_load_of(p, s.pair, s.resultant);
  watch.lap(times.searches);
}

void PairContacts::add_load_of(const Particles &p, const std::int32_t pair, const Resultant &resultant)
{
  const std::int32_t i = list.first[pair], j = list.second[pair];
  LoadSums &loads = are_spheres(i, j) ? sphere_loads : grain_loads;
  loads.add(slot[pair], resultant);
  const Image image = list.image[pair];
  if (p.cell.is_periodic())
    loads.virial_of_slot(slot[pair]).add(0.5 * p.branch(i, j, image), p.cell.place[image], resultant.force);
}

void PairContacts::list_bodies(const std::size_t n_grains)
{
  if (!grain_loads.is_current())
    grain_loads.list_bodies(grains.first, grains.second, n_grains);
  if (!sphere_loads.is_current())
    sphere_loads.list_bodies(spheres.first, spheres.second, n_grains);
}

/// Slot of a touching pair of the same kind shortly before a pair in the list, mostly of the same grain; `apart` if
/// there is none.
std::int32_t PairContacts::slot_near(const std::int32_t pair) const
{
  constexpr std::int32_t reach = 64;
  const auto is_of_spheres = [&](const std::int32_t k) { return are_spheres(list.first[k], list.second[k]); };
  for (std::int32_t k = pair - 1; k >= std::max(pair - reach, 0); --k)
    if (slot[k] != apart && is_of_spheres(k) == is_of_spheres(pair))
      return slot[k];
  return apart;
}

void PairContacts::refresh(const Particles &p)
{
  for (ContactState<Pack> &block : grains.blocks)
    block.budget = math::select(block.weight > 0., Pack(-1.), block.budget);
  for (std::size_t s = 0; s < spheres.n_slots(); ++s)
    if (spheres.pair[s] != spheres.free_slot)
    {
      SphereContactState<double> state = spheres.get(static_cast<std::int32_t>(s));
      state.weight = sphere_weight(p, spheres.first[s], spheres.second[s]);
      spheres.set(static_cast<std::int32_t>(s), state);
    }
}

std::vector<TouchingContact> PairContacts::touching(const Particles &p) const
{
  std::vector<TouchingContact> contacts;
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    if (slot[pair] == apart)
      continue;
    const std::int32_t i = list.first[pair], j = list.second[pair];
    const Image image = list.image[pair];
    const Vec3 branch = p.branch(i, j, image);
    if (!are_spheres(i, j))
    {
      contacts.push_back({i, j, grains.get(slot[pair]), branch, image});
      continue;
    }
    const SphereContactState<double> sphere = spheres.get(slot[pair]);
    const SphereGeometry<double> g = sphere_geometry(p, {i, j, image});
    ContactState<double> s = ContactState<double>::begin();
    s.normal = g.normal;
    s.point = g.point;
    s.major_axis = tangent_frame(g.normal).col(0);
    s.forces = sphere.forces;
    s.overlap = sphere.overlap();
    s.stiffness = {sphere.normal_stiffness, sphere.tangential_stiffness, sphere.tangential_stiffness};
    s.reduced_mass = sphere.reduced_mass;
    s.weight = sphere.weight;
    contacts.push_back({i, j, s, branch, image});
  }
  return contacts;
}

ContactEnergy PairContacts::total_energy() const
{
  ContactEnergy sum;
  const auto add = [&](const ContactEnergy &e)
  {
    sum.normal += e.normal;
    sum.tangential += e.tangential;
  };
  const auto add_all = [&](const auto &store)
  {
    for (std::size_t s = 0; s < store.n_slots(); ++s)
      if (store.pair[s] != store.free_slot)
        add(stored_energy(store.get(static_cast<std::int32_t>(s))));
  };
  add_all(grains);
  add_all(spheres);
  return sum;
}

} // namespace bergamo::dem
