#include "dem/force/kinds/sphere_sphere.h"

#include "dem/core/tangent_frame.h"
#include "dem/force/follow.h"
#include "dem/force/follow_spheres.h"

namespace bergamo::dem
{
namespace
{

/// Radii of the two spheres [m]: the particles are nothing but them.
struct Radii
{
  double first, second;
};

Radii radii_of(const Particles &p, const ContactSearch &pair)
{
  return {p.parts.bounding_radius[pair.first_part], p.parts.bounding_radius[pair.second_part]};
}

SphereGeometry<double> geometry_of(const Particles &p, const ContactSearch &pair)
{
  const auto [first, second] = radii_of(p, pair);
  return {0.5 * p.branch(pair.first, pair.second, pair.image), first + second, first - second};
}

/// Interpolated to the point of contact, Wellmann (6.29); see contact_weight() of search_contacts.cc.
double weight_of(const double weight1, const double weight2, const double radius1, const double radius2)
{
  if (weight1 == 1. || weight2 == 1.)
    return 1.;
  const double fraction = radius1 / (radius1 + radius2);
  return weight1 + fraction * (weight2 - weight1);
}

/// The state of two spheres about to touch.
SphereContactState<double> begin(const ContactScene &scene, const ContactSearch &pair)
{
  const Particles &p = scene.particles;
  const auto [radius1, radius2] = radii_of(p, pair);
  const double curvature = 0.5 * (1. / radius1 + 1. / radius2);
  const HertzMindlin<double> stiffness = hertz_mindlin(curvature, curvature, scene.law.elastic);
  SphereContactState<double> s = SphereContactState<double>::idle();
  s.root_overlap = 0.;
  s.normal_stiffness = stiffness.normal;
  s.tangential_stiffness = stiffness.tangential_major;
  s.reduced_mass = 1. / (1. / p.mass[pair.first] + 1. / p.mass[pair.second]);
  s.weight = weight_of(p.weight[pair.first], p.weight[pair.second], radius1, radius2);
  s.radius_sum = radius1 + radius2;
  s.radius_difference = radius1 - radius2;
  return s;
}

} // namespace

math::Mask<Pack> SphereSphere::follow_block(Store &store, LoadSums &loads, const std::size_t block,
                                            const ContactScene &scene, Losses<Pack> &losses)
{
  return dem::follow_block(store, loads, block, scene.particles, scene.law, scene.time_step, losses);
}

void SphereSphere::search(const std::span<ContactSearch> searches, const SearchContext<SphereSphere> &context,
                          ContactLosses &losses, std::vector<BegunContact<SphereSphere>> &begun)
{
  for (std::size_t k = 0; k < searches.size(); ++k)
  {
    ContactSearch &search = searches[k];
    const double overlap = geometry_of(context.scene.particles, search).overlap;
    search.is_touching = overlap > 0.;
    search.gap = -overlap;
    if (!search.is_touching)
      continue;
    State state = search.slot >= 0 ? context.store.get(search.slot) : begin(context.scene, search);
    const auto f = follow(state, motion_of_pair(search, context.scene), context.scene.law, losses);
    search.resultant = {f.force, f.torque1, f.torque2};
    if (search.slot >= 0)
      context.store.set(search.slot, state);
    else
      begun.push_back({k, state});
  }
}

ContactLosses SphereSphere::end(const ContactSearch &search, const State &state, const ContactScene &scene)
{
  const SphereGeometry<double> g = geometry_of(scene.particles, search);
  return separate(state, motion_of_spheres(g, state, motion_of_pair(search, scene)));
}

void SphereSphere::exchange_bodies(State &s)
{
  s.forces.tangential = -s.forces.tangential;
  s.radius_difference = -s.radius_difference;
}

void SphereSphere::refresh(Store &store, const Particles &p)
{
  for (std::size_t slot = 0; slot < store.n_slots(); ++slot)
    if (store.pair[slot] != store.free_slot)
    {
      State state = store.get(static_cast<std::int32_t>(slot));
      const double radius1 = 0.5 * (state.radius_sum + state.radius_difference);
      state.weight =
          weight_of(p.weight[store.first[slot]], p.weight[store.second[slot]], radius1, state.radius_sum - radius1);
      store.set(static_cast<std::int32_t>(slot), state);
    }
}

TouchingContact SphereSphere::view(const ContactSearch &place, const State &sphere, const Particles &particles)
{
  const SphereGeometry<double> g = geometry_of(particles, place);
  ContactView s;
  s.normal = g.normal;
  s.major_axis = tangent_frame(g.normal).col(0);
  s.point = g.point;
  s.forces = sphere.forces;
  s.overlap = sphere.overlap();
  s.stiffness = {sphere.normal_stiffness, sphere.tangential_stiffness, sphere.tangential_stiffness};
  s.reduced_mass = sphere.reduced_mass;
  s.weight = sphere.weight;
  s.energy = stored_energy(sphere);
  return {place.first, place.second, s, particles.branch(place.first, place.second, place.image), place.image};
}

} // namespace bergamo::dem
