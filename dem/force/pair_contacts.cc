#include "dem/force/pair_contacts.h"

#include "dem/core/parallel.h"
#include "dem/force/follow.h"
#include "dem/force/follow_spheres.h"
#include "dem/force/search_contacts.h"
#include "dem/neighbour/cell_grid.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace bergamo::dem
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t group_size = 64; // pairs that screening leaves alone together

/// A pair of spheres whose contact begins in this step.
struct NewSphereContact
{
  std::int32_t pair;
  SphereContactState<double> state;
  SphereResultant resultant;
};

/// The same contact seen with its bodies exchanged.
void exchange_bodies(ContactState<double> &s)
{
  s.normal = -s.normal;
  s.forces.tangential = -s.forces.tangential;
  s.spin = -s.spin; // about the normal
}

void exchange_bodies(SphereContactState<double> &s)
{
  s.forces.tangential = -s.forces.tangential;
}

PairMotion<double> motion_of(const Particles &p, const std::int32_t i, const std::int32_t j, const double time_step)
{
  return {p, [=](int) { return i; }, [=](int) { return j; }, time_step};
}

SphereGeometry<double> sphere_geometry(const Particles &p, const std::int32_t i, const std::int32_t j)
{
  return {0.5 * (p.position[j] - p.position[i]), p.bounding_radius[i] + p.bounding_radius[j],
          p.bounding_radius[i] - p.bounding_radius[j]};
}

double sphere_weight(const Particles &p, const std::int32_t i, const std::int32_t j)
{
  const double fraction = p.bounding_radius[i] / (p.bounding_radius[i] + p.bounding_radius[j]);
  return p.weight[i] + fraction * (p.weight[j] - p.weight[i]);
}

/// Two spheres that begin to touch in this step.
NewSphereContact begin_spheres(const Particles &p, const std::int32_t pair, const std::int32_t i, const std::int32_t j,
                               const ContactLaw &law, const double time_step, ContactLosses &losses)
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
  NewSphereContact contact{pair, s, {}};
  follow(contact.state, motion_of(p, i, j, time_step), law, losses,
         [&](int) -> SphereResultant & { return contact.resultant; });
  return contact;
}

/// Moves contacts to slots in the order of their pairs. @param pairs those that touch, in their order
template <template <class> class State>
void compact(ContactStore<State> &store, const std::vector<std::int32_t> &pairs,
             std::vector<std::int32_t> &slot_of_pair)
{
  ContactStore<State> ordered;
  ordered.resize(pairs.size());
  parallel_for(pairs.size(),
               [&](const std::size_t k)
               {
                 const std::int32_t pair = pairs[k], from = slot_of_pair[pair], to = static_cast<std::int32_t>(k);
                 ordered.pair[to] = pair;
                 ordered.first[to] = store.first[from];
                 ordered.second[to] = store.second[from];
                 ordered.resultant[to] = store.resultant[from];
                 ordered.set(to, store.get(from));
                 slot_of_pair[pair] = to;
               });
  store = std::move(ordered);
}

} // namespace

void PairContacts::compute(const Particles &p, const ContactLaw &law, const ContactParameters &parameters,
                           const double time_step, PhaseTimes &times)
{
  Stopwatch watch;

  // 1. Touching contacts.
  const auto due = follow_all(grains, losses,
                              [&](const std::size_t block, Losses<Pack> &lost)
                              { return follow_block(grains, block, p, law, time_step, lost); });
  const auto ended_spheres = follow_all(spheres, losses,
                                        [&](const std::size_t block, Losses<Pack> &lost)
                                        { return follow_block(spheres, block, p, law, time_step, lost); });
  watch.lap(times.contacts);

  // 2. Pairs apart.
  Collected<std::int32_t> candidates, begun_spheres;
  parallel_ranges(group_rest_until.size(), 16,
                  [&](const std::size_t thread, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t group = begin; group < end; ++group)
                    {
                      if (p.largest_motion < group_rest_until[group])
                        continue;
                      double slack = infinity;
                      const std::size_t last = std::min((group + 1) * group_size, list.size());
                      for (std::size_t pair = group * group_size; pair < last; ++pair)
                      {
                        if (slot[pair] != apart)
                          continue;
                        const std::int32_t i = list.first[pair], j = list.second[pair];
                        const double motion = p.motion[i] + p.motion[j];
                        if (!(motion < rest_until[pair]))
                        {
                          if (!are_spheres(i, j))
                          {
                            candidates.of(thread).push_back(static_cast<std::int32_t>(pair));
                            slack = 0.;
                            continue;
                          }
                          const double overlap = sphere_geometry(p, i, j).overlap;
                          if (overlap > 0.)
                          {
                            begun_spheres.of(thread).push_back(static_cast<std::int32_t>(pair));
                            continue;
                          }
                          rest_until[pair] = motion - overlap;
                        }
                        slack = std::min(slack, rest_until[pair] - motion);
                      }
                      group_rest_until[group] = p.largest_motion + 0.5 * slack; // both grains of a pair move
                    }
                  });
  watch.lap(times.screening);

  // 3. Searches.
  std::vector<ContactSearch> searches;
  due.for_each(
      [&](const std::int32_t s) {
        searches.push_back({grains.pair[s], grains.first[s], grains.second[s], s});
      });
  candidates.for_each(
      [&](const std::int32_t pair) {
        searches.push_back({pair, list.first[pair], list.second[pair], apart});
      });
  const std::size_t n_packs = (searches.size() + pack_width - 1) / pack_width;
  std::vector<ContactLosses> pack_losses(n_packs);
  Collected<BegunContact> begun;
  const SearchContext context{p, law, parameters, time_step, grains, separating_direction};
  parallel_ranges(n_packs, 1,
                  [&](const std::size_t thread, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t pack = begin; pack < end; ++pack)
                    {
                      const std::size_t from = pack * pack_width, to = std::min(from + pack_width, searches.size());
                      search_contacts(std::span(searches).subspan(from, to - from), context, pack_losses[pack],
                                      begun.of(thread));
                    }
                  });
  for (const ContactLosses &lost : pack_losses)
    losses += lost;
  n_searches += static_cast<std::int64_t>(searches.size());

  // Contacts that began or ended take and leave their slots one by one.
  std::vector<std::int32_t> changed; // pairs
  const auto leave = [&](const std::int32_t pair)
  {
    slot[pair] = apart;
    group_rest_until[pair / group_size] = -infinity;
    changed.push_back(pair);
  };
  const auto enter = [&](const std::int32_t pair, const std::int32_t new_slot)
  {
    slot[pair] = new_slot;
    changed.push_back(pair);
  };
  for (const ContactSearch &s : searches)
  {
    n_undecided += s.is_undecided;
    if (s.is_touching)
      continue;
    rest_until[s.pair] = p.motion[s.first] + p.motion[s.second] + s.gap;
    if (s.slot == apart)
      continue;
    const ContactState<double> state = grains.get(s.slot);
    losses += separate(state, state.normal, motion_of(p, s.first, s.second, time_step).displacement(state.point));
    grains.remove(s.slot);
    leave(s.pair);
  }
  begun.for_each([&](const BegunContact &c)
                 { enter(c.pair, grains.add(c.pair, c.first, c.second, c.state, c.resultant)); });
  ended_spheres.for_each(
      [&](const std::int32_t s)
      {
        const std::int32_t i = spheres.first[s], j = spheres.second[s], pair = spheres.pair[s];
        const SphereGeometry<double> g = sphere_geometry(p, i, j);
        losses += separate(spheres.get(s), g.normal, motion_of(p, i, j, time_step).displacement(g.point));
        rest_until[pair] = p.motion[i] + p.motion[j] - g.overlap;
        spheres.remove(s);
        leave(pair);
      });
  begun_spheres.for_each(
      [&](const std::int32_t pair)
      {
        const std::int32_t i = list.first[pair], j = list.second[pair];
        const NewSphereContact s = begin_spheres(p, pair, i, j, law, time_step, losses);
        enter(pair, spheres.add(pair, i, j, s.state, s.resultant));
      });
  for (std::size_t k = 0; k < changed.size() && incidence.is_current; ++k)
    for (const std::int32_t i : {list.first[changed[k]], list.second[changed[k]]})
      renew_incidence_row(i);
  if (!incidence.is_current)
    renew_incidence(p.size());
  watch.lap(times.searches);
}

void PairContacts::renew_incidence_row(const std::int32_t i)
{
  const std::int32_t end = incidence.row[i + 1];
  std::int32_t next = incidence.row[i];
  const auto add = [&](const std::int32_t pair, const int side)
  {
    if (slot[pair] == apart)
      return;
    if (next == end)
    {
      incidence.is_current = false; // the row overflows
      return;
    }
    incidence.entries[next++] = slot[pair] * 4 + are_spheres(list.first[pair], list.second[pair]) * 2 + side;
  };
  for (auto pair = list.row[i]; pair < list.row[i + 1]; ++pair)
    add(pair, 0);
  for (auto k = list.incoming_row[i]; k < list.incoming_row[i + 1]; ++k)
    add(list.incoming[k], 1);
  incidence.count[i] = next - incidence.row[i];
}

void PairContacts::renew_incidence(const std::size_t n)
{
  constexpr std::int32_t room = 3; // for contacts that begin
  incidence.row.assign(n + 1, 0);
  incidence.count.resize(n);
  parallel_for(n,
               [&](const std::size_t i)
               {
                 std::int32_t count = 0;
                 for (auto pair = list.row[i]; pair < list.row[i + 1]; ++pair)
                   count += slot[pair] != apart;
                 for (auto k = list.incoming_row[i]; k < list.incoming_row[i + 1]; ++k)
                   count += slot[list.incoming[k]] != apart;
                 incidence.row[i + 1] = count + room;
               });
  std::partial_sum(incidence.row.begin(), incidence.row.end(), incidence.row.begin());
  incidence.entries.resize(incidence.row[n]);
  incidence.is_current = true;
  parallel_for(n, [&](const std::size_t i) { renew_incidence_row(static_cast<std::int32_t>(i)); });
}

void PairContacts::renew(VerletList new_list, const Particles &particles)
{
  std::vector<std::int32_t> new_slot(new_list.size(), apart);
  std::vector<double> new_rest(new_list.size(), -infinity);
  std::vector<Eigen::Vector3f> new_direction(new_list.size(), Eigen::Vector3f::Zero());
  Collected<std::int32_t> left;
  const bool had_list = !list.row.empty();
  parallel_ranges(particles.size(), 64,
                  [&](const std::size_t thread, const std::size_t begin, const std::size_t end)
                  {
                    for (std::size_t i = begin; i < end; ++i)
                    {
                      // Both rows are sorted by the second partner: walk them together.
                      std::size_t old_pair = had_list ? list.row[i] : 0;
                      const std::size_t old_end = had_list ? list.row[i + 1] : 0;
                      const auto leave = [&]
                      {
                        if (slot[old_pair] != apart)
                          left.of(thread).push_back(static_cast<std::int32_t>(old_pair));
                        ++old_pair;
                      };
                      for (auto pair = new_list.row[i]; pair < new_list.row[i + 1]; ++pair)
                      {
                        while (old_pair < old_end && list.second[old_pair] < new_list.second[pair])
                          leave();
                        if (old_pair < old_end && list.second[old_pair] == new_list.second[pair])
                        {
                          new_slot[pair] = slot[old_pair];
                          new_rest[pair] = rest_until[old_pair];
                          new_direction[pair] = separating_direction[old_pair];
                          ++old_pair;
                        }
                      }
                      while (old_pair < old_end)
                        leave();
                    }
                  });
  left.for_each(
      [&](const std::int32_t pair)
      {
        if (are_spheres(list.first[pair], list.second[pair]))
        {
          losses += release(spheres.get(slot[pair]));
          spheres.remove(slot[pair]);
        }
        else
        {
          losses += release(grains.get(slot[pair]));
          grains.remove(slot[pair]);
        }
      });
  is_sphere.resize(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    is_sphere[i] = particles.shape[i].is_sphere();
  list = std::move(new_list);
  slot = std::move(new_slot);
  rest_until = std::move(new_rest);
  separating_direction = std::move(new_direction);
  std::vector<std::int32_t> grain_pairs, sphere_pairs;
  for (std::size_t pair = 0; pair < list.size(); ++pair)
    if (slot[pair] != apart)
    {
      const bool is_sphere = are_spheres(list.first[pair], list.second[pair]);
      (is_sphere ? sphere_pairs : grain_pairs).push_back(static_cast<std::int32_t>(pair));
    }
  compact(grains, grain_pairs, slot);
  compact(spheres, sphere_pairs, slot);
  group_rest_until.assign((list.size() + group_size - 1) / group_size, -infinity);
  incidence.is_current = false;
}

void PairContacts::reorder(const std::vector<std::int32_t> &order, const Particles &reordered)
{
  const std::vector<std::int32_t> new_index = inverse_order(order);
  for (std::size_t i = 0; i < is_sphere.size(); ++i)
    is_sphere[i] = reordered.shape[i].is_sphere();
  struct Place
  {
    std::int32_t first, second, pair;
    bool is_exchanged;
  };
  std::vector<Place> places(list.size());
  for (std::size_t pair = 0; pair < list.size(); ++pair)
  {
    const std::int32_t i = new_index[list.first[pair]], j = new_index[list.second[pair]];
    places[pair] = {std::min(i, j), std::max(i, j), static_cast<std::int32_t>(pair), i > j};
  }
  std::sort(places.begin(), places.end(),
            [](const Place &a, const Place &b)
            { return a.first != b.first ? a.first < b.first : a.second < b.second; });

  VerletList sorted;
  sorted.row.assign(reordered.size() + 1, 0);
  std::vector<std::int32_t> sorted_slot;
  std::vector<double> sorted_rest;
  std::vector<Eigen::Vector3f> sorted_direction;
  const auto exchange = [](auto &store, const std::int32_t slot)
  {
    auto state = store.get(slot);
    exchange_bodies(state);
    store.set(slot, state);
  };
  for (const Place &place : places)
  {
    ++sorted.row[place.first + 1];
    sorted.first.push_back(place.first);
    sorted.second.push_back(place.second);
    sorted_slot.push_back(slot[place.pair]);
    sorted_rest.push_back(rest_until[place.pair]);
    const float sign = place.is_exchanged ? -1.f : 1.f;
    sorted_direction.push_back(sign * separating_direction[place.pair]);
    if (slot[place.pair] == apart)
      continue;
    const std::int32_t s = slot[place.pair];
    const bool is_sphere = are_spheres(place.first, place.second);
    if (place.is_exchanged && is_sphere)
      exchange(spheres, s);
    else if (place.is_exchanged)
      exchange(grains, s);
    (is_sphere ? spheres.first : grains.first)[s] = place.first;
    (is_sphere ? spheres.second : grains.second)[s] = place.second;
  }
  std::partial_sum(sorted.row.begin(), sorted.row.end(), sorted.row.begin());
  list = std::move(sorted);
  slot = std::move(sorted_slot);
  rest_until = std::move(sorted_rest);
  separating_direction = std::move(sorted_direction);
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
    if (!are_spheres(i, j))
    {
      contacts.push_back({i, j, grains.get(slot[pair])});
      continue;
    }
    const SphereContactState<double> sphere = spheres.get(slot[pair]);
    const SphereGeometry<double> g = sphere_geometry(p, i, j);
    ContactState<double> s = ContactState<double>::begin();
    s.normal = g.normal;
    s.point = g.point;
    s.major_axis = tangent_frame(g.normal).col(0);
    s.forces = sphere.forces;
    s.overlap = sphere.overlap();
    s.stiffness = {sphere.normal_stiffness, sphere.tangential_stiffness, sphere.tangential_stiffness};
    s.reduced_mass = sphere.reduced_mass;
    s.weight = sphere.weight;
    contacts.push_back({i, j, s});
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
