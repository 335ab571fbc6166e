#include "dem/force/contacts.h"

#include "dem/core/parallel.h"

#include <utility>

namespace bergamo::dem
{

std::vector<ContactLaw> contact_laws(const MaterialTable &materials)
{
  std::vector<ContactLaw> laws;
  for (std::int32_t second = 0; second < materials.size(); ++second)
    for (std::int32_t first = 0; first <= second; ++first)
    {
      const SurfacePair &pair = materials.between(first, second);
      laws.push_back(
          {elastic_pair(materials[first], materials[second]), pair.friction, pair.damping_ratio, pair.relaxation_time});
    }
  return laws;
}

Contacts::Contacts(const std::int32_t n_material_pairs)
{
  for_each_kind(*this, [&](const char *, auto &sets) { sets.resize(n_material_pairs); });
}

void Contacts::renew(const Particles &particles, const std::vector<PlaneWall> &walls,
                     const std::span<const Surface> surfaces, CandidateSearch search)
{
  const Parts &parts = particles.parts;
  std::vector<Vec3> places;
  if (search.places.empty())
  {
    places.resize(parts.size());
    parallel_for(parts.size(), [&](const std::size_t k) { places[k] = particles.part_position(k); });
    search.places = places;
  }
  const std::size_t n_laws = grain_grain.size();
  std::vector<std::uint8_t> is_sphere(parts.size());
  parallel_for(parts.size(), [&](const std::size_t k) { is_sphere[k] = parts.is_central_sphere(k); });
  const auto law_of_parts = [&](const std::int32_t i, const std::int32_t j)
  { return MaterialTable::pair_number(parts.material[i], parts.material[j]); };

  std::vector<VerletList> lists = split(near_parts(particles, search), 2 * n_laws,
                                        [&](const std::int32_t i, const std::int32_t j)
                                        { return (is_sphere[i] && is_sphere[j] ? n_laws : 0) + law_of_parts(i, j); });
  for (std::size_t law = 0; law < n_laws; ++law)
  {
    grain_grain[law].renew(lists[law], particles, search.sought);
    sphere_sphere[law].renew(lists[n_laws + law], particles, search.sought);
  }

  std::vector<VerletList> near_walls =
      split(parts_near_walls(particles, walls, search), n_laws,
            [&](const std::int32_t part, const std::int32_t wall)
            { return MaterialTable::pair_number(parts.material[part], walls[wall].material); });
  for (std::size_t law = 0; law < n_laws; ++law)
    grain_plane[law].renew(near_walls[law], particles, search.sought);

  faces = face_tree(surfaces, faces);
  std::vector<VerletList> near_surfaces = split(parts_near_surfaces(particles, surfaces, search, *faces), n_laws,
                                                [&](const std::int32_t part, const std::int32_t feature)
                                                {
                                                  const std::int32_t material =
                                                      surfaces[feature_of(surfaces, feature).surface].material;
                                                  return MaterialTable::pair_number(parts.material[part], material);
                                                });
  for (std::size_t law = 0; law < n_laws; ++law)
    grain_surface[law].renew(near_surfaces[law], particles, search.sought);
}

void Contacts::reorder(const std::vector<std::int32_t> &part_order, const std::size_t n_old)
{
  std::vector<std::int32_t> new_part(n_old, removed_part);
  for (std::size_t k = 0; k < part_order.size(); ++k)
    new_part[part_order[k]] = static_cast<std::int32_t>(k);
  for_each_set(*this, [&](auto &set, std::int32_t) { set.reorder(new_part, part_order.size()); });
}

void Contacts::repeat(const CellCopies &copies, const std::size_t n_parts)
{
  for_each_set(*this, [&](auto &set, std::int32_t) { set.repeat(copies, n_parts); });
}

void Contacts::remove_wall(const std::int32_t wall)
{
  for (ContactSet<GrainPlane> &set : grain_plane)
    set.remove_walls(wall, 1);
}

void Contacts::remove_features(const std::int32_t first, const std::int32_t n)
{
  for (ContactSet<GrainSurface> &set : grain_surface)
    set.remove_walls(first, n);
}

void Contacts::compute(const Particles &particles, const std::vector<PlaneWall> &walls, const ContactStep &step,
                       PhaseTimes &times)
{
  double surface_motion = 0.;
  for (const Surface &surface : step.surfaces)
    surface_motion += surface.motion;
  for_each_set(*this,
               [&](auto &set, const std::int32_t law)
               {
                 set.compute(
                     {particles, walls, step.laws[law], step.parameters, step.time_step, step.surfaces, surface_motion},
                     times);
               });
}

std::vector<const LoadSums *> Contacts::load_sums() const
{
  std::vector<const LoadSums *> sums;
  for_each_set(*this,
               [&](const auto &set, std::int32_t)
               {
                 if (set.load_sums().n_chunks() > 0)
                   sums.push_back(&set.load_sums());
               });
  return sums;
}

Virial<double> Contacts::virial() const
{
  Virial<double> sum;
  for_each_set(*this, [&](const auto &set, std::int32_t) { set.add_virial(sum); });
  return sum;
}

void Contacts::refresh(const Particles &particles)
{
  for_each_set(*this, [&](auto &set, std::int32_t) { set.refresh(particles); });
}

std::vector<TouchingContact> Contacts::touching(const Particles &particles) const
{
  std::vector<TouchingContact> contacts;
  for_each_set(*this,
               [&]<class Kind>(const ContactSet<Kind> &set, const std::int32_t law)
               {
                 if constexpr (!Kind::second_is_wall)
                   set.list_touching(particles, law, contacts);
               });
  return contacts;
}

std::vector<TouchingContact> Contacts::touching_walls(const Particles &particles) const
{
  std::vector<TouchingContact> contacts;
  for_each_set(*this,
               [&]<class Kind>(const ContactSet<Kind> &set, const std::int32_t law)
               {
                 if constexpr (Kind::second_is_wall)
                   set.list_touching(particles, law, contacts);
               });
  return contacts;
}

ContactEnergy Contacts::total_energy() const
{
  ContactEnergy sum;
  for_each_set(*this,
               [&](const auto &set, std::int32_t)
               {
                 const ContactEnergy e = set.total_energy();
                 sum.normal += e.normal;
                 sum.tangential += e.tangential;
               });
  return sum;
}

ContactLosses Contacts::losses() const
{
  ContactLosses sum;
  for_each_set(*this, [&](const auto &set, std::int32_t) { sum += set.losses; });
  return sum;
}

void Contacts::open_accounts()
{
  for_each_set(*this, [&](auto &set, std::int32_t) { set.open_accounts(); });
}

std::vector<double> Contacts::friction_work(const std::size_t n_features) const
{
  std::vector<double> work(n_features, 0.);
  for (const ContactSet<GrainSurface> &set : grain_surface)
    set.add_friction_work(work);
  return work;
}

namespace
{

/// Sum of number(set) over the sets with walls, or without.
template <bool with_walls, class Number>
auto sum_over(const Contacts &contacts, const Number &number)
{
  decltype(number(contacts.grain_grain[0])) sum = 0;
  Contacts::for_each_set(contacts,
                         [&]<class Kind>(const ContactSet<Kind> &set, std::int32_t)
                         {
                           if constexpr (Kind::second_is_wall == with_walls)
                             sum += number(set);
                         });
  return sum;
}

} // namespace

std::int32_t Contacts::n_touching() const
{
  return sum_over<false>(*this, [](const auto &set) { return set.n_touching(); });
}

std::int32_t Contacts::n_touching_walls() const
{
  return sum_over<true>(*this, [](const auto &set) { return set.n_touching(); });
}

std::int64_t Contacts::n_candidates() const
{
  return sum_over<false>(*this, [](const auto &set) { return static_cast<std::int64_t>(set.size()); });
}

std::int64_t Contacts::n_searches() const
{
  return sum_over<false>(*this, [](const auto &set) { return set.n_searches; });
}

std::int64_t Contacts::n_undecided() const
{
  return sum_over<false>(*this, [](const auto &set) { return set.n_undecided; });
}

} // namespace bergamo::dem
