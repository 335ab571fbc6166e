#include "dem/force/kinds/grain_surface.h"

#include "dem/force/follow.h"
#include "dem/force/kinds/against_flat.h"
#include "dem/force/kinds/feature_motion.h"
#include "dem/force/searched_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace bergamo::dem
{
namespace
{

/// @param grain a particle; @param feature see feature_of(); @param point of the contact minus the grain's centre [m]
FeatureMotion<double> motion_of(const std::int32_t grain, const std::int32_t feature, const ContactScene &scene,
                                const Vec3 &point)
{
  const Particles &p = scene.particles;
  const FeatureOfSurface f = feature_of(scene.surfaces, feature);
  const Surface &surface = scene.surfaces[f.surface];
  FeatureMotion<double> motion;
  const Vec3 place = p.position[grain] + point, velocity = p.drift_velocity[grain];
  motion.velocity = surface.velocity_at(f, place) - velocity;
  if (!surface.is_at_rest()) // what touched halfway has gone on with the surface since, by half of the slip
    motion.velocity = surface.velocity_at(f, place + 0.5 * scene.time_step * motion.velocity) - velocity;
  motion.spin = p.angular_velocity[grain];
  motion.time_step = scene.time_step;
  motion.feature_spin = surface.spin_of(f);
  motion.edge = f.feature == Feature::edge ? surface.direction_of_edge(f.number) : Vec3(Vec3::Zero());
  motion.is_face = f.feature == Feature::face;
  motion.is_edge = f.feature == Feature::edge;
  return motion;
}

/// Of a free lane.
FeatureMotion<double> at_rest(const double time_step)
{
  const Vec3 zero = Vec3::Zero();
  return {{zero, zero, time_step}, zero, zero, 1., 0.};
}

/// The touching contact of the same part that a new one takes over from: the nearest in direction, about as deep.
std::optional<SurfaceContactState<double>> taken_over(const ContactSearch &search,
                                                      const SearchContext<GrainSurface> &context,
                                                      const SurfacePlace &place, SurfaceLook &look)
{
  constexpr double largest_turn_of_normal = 0.5; // [rad]: over an edge the normal turns with the part
  constexpr double depth_range = 2.;
  std::optional<SurfaceContactState<double>> found;
  double nearest = std::cos(largest_turn_of_normal);
  const std::int32_t surface = feature_of(context.scene.surfaces, search.second).surface;
  for (auto pair = context.list.row[search.first_part]; pair < context.list.row[search.first_part + 1]; ++pair)
  {
    const FeatureOfSurface f = feature_of(context.scene.surfaces, context.list.second[pair]);
    if (context.slot[pair] < 0 || f.surface != surface || !(look.overlap_at(f.feature, f.number) > 0.))
      continue;
    const SurfaceContactState<double> other = context.store.get(context.slot[pair]);
    const double alike = -other.normal.dot(place.normal), ratio = place.overlap / other.overlap;
    if (alike <= nearest || ratio > depth_range || ratio * depth_range < 1.)
      continue;
    nearest = alike;
    found = other;
  }
  return found;
}

/// Overlap of a part's deepest contact with a surface, at the step before; 0 where it touches nothing of it [m].
double deepest_contact_with(const std::int32_t surface, const ContactSearch &search,
                            const SearchContext<GrainSurface> &context)
{
  double deepest = 0.;
  for (auto pair = context.list.row[search.first_part]; pair < context.list.row[search.first_part + 1]; ++pair)
    if (context.slot[pair] >= 0 && feature_of(context.scene.surfaces, context.list.second[pair]).surface == surface)
      deepest = std::max(deepest, context.store.get(context.slot[pair]).overlap);
  return deepest;
}

/// Whether a part may touch at a place at once: it is hardly deep there, or about as deep as at another of the surface,
/// which it has come from.
bool may_begin(const SurfacePlace &place, const SurfaceLook &look, const std::int32_t surface,
               const ContactSearch &search, const SearchContext<GrainSurface> &context)
{
  constexpr double depth_range = 2.;
  return look.may_begin(place) || place.overlap <= depth_range * deepest_contact_with(surface, search, context);
}

/// Whether a feature that the part reaches without a place there cannot get one before a contact of the same part is
/// searched: one on a face that leans no more against it than what is followed at once, so that the deepest points on
/// both move alike, and where it lies further from any border than that contact may go.
bool is_guarded(const ContactSearch &search, const SearchContext<GrainSurface> &context, SurfaceLook &look)
{
  constexpr double safety = 1.2;
  const FeatureOfSurface f = feature_of(context.scene.surfaces, search.second);
  const Surface &surface = context.scene.surfaces[f.surface];
  if (!(surface.is_at_rest() || surface.is_rigid) || look.index_of(f.feature, f.number) != 0)
    return false;
  const double margin = look.margin();
  const Vec3 normal = look.normal_beside(f.feature, f.number);
  for (auto pair = context.list.row[search.first_part]; pair < context.list.row[search.first_part + 1]; ++pair)
  {
    if (context.slot[pair] < 0)
      continue;
    const FeatureOfSurface other = feature_of(context.scene.surfaces, context.list.second[pair]);
    if (other.feature != Feature::face || other.surface != f.surface)
      continue;
    const ContactState<double> contact = context.store.get(context.slot[pair]);
    if (safety < margin * contact.radii2.r11 && (contact.normal + normal).norm() < largest_turn)
      return true;
  }
  return false;
}

/// The part's view of a surface, kept while searches of one part follow one another.
class PartLook
{
public:
  PartLook(const ContactSearch &search, const Particles &p, const Surface &surface)
      : part(search.first_part), of(&surface), pose(pose_of(p, search.first_part, search.first)), view(surface.view()),
        look(pose, view)
  {
  }
  PartLook(const PartLook &) = delete;

  bool is_of(const ContactSearch &search, const Surface &surface) const
  {
    return part == search.first_part && of == &surface;
  }

private:
  std::int32_t part;
  const Surface *of;
  BodyPose pose;
  SurfaceView view;

public:
  SurfaceLook look;
};

} // namespace

math::Mask<Pack> GrainSurface::follow_block(Store &store, LoadSums &loads, const std::size_t block,
                                            const ContactScene &scene, Losses<Pack> &losses)
{
  SurfaceContactState<Pack> &state = store.blocks[block];
  std::array<FeatureMotion<double>, pack_width> of_lane;
  for (int lane = 0; lane < pack_width; ++lane)
  {
    const auto slot = static_cast<std::int32_t>(block * pack_width + lane);
    const bool is_free = store.pair[slot] == Store::free_slot;
    of_lane[lane] = is_free
                        ? at_rest(scene.time_step)
                        : motion_of(store.first[slot], store.second[slot], scene, math::lane<Pack>(state.point, lane));
  }
  const auto gather = [&](const auto &member)
  {
    return math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return of_lane[lane].*member; });
  };
  const auto gather_numbers = [&](const auto &member)
  { return math::generate<Pack>([&](const int lane) { return of_lane[lane].*member; }); };
  using Motion = FeatureMotion<double>;
  FeatureMotion<Pack> motion;
  motion.velocity = gather(&Motion::velocity);
  motion.spin = gather(&Motion::spin);
  motion.time_step = scene.time_step;
  motion.feature_spin = gather(&Motion::feature_spin);
  motion.edge = gather(&Motion::edge);
  motion.is_face = gather_numbers(&Motion::is_face);
  motion.is_edge = gather_numbers(&Motion::is_edge);
  Losses<Pack> lost;
  const Followed<Pack> followed = follow<Pack>(state, motion, scene.law, lost);
  state.friction_work += lost.friction;
  losses += lost;
  loads.add(block, followed.force, state.point.cross(followed.force), Vector3<Pack>(0., 0., 0.));
  return followed.is_due;
}

void GrainSurface::search(const std::span<ContactSearch> searches, const SearchContext<GrainSurface> &context,
                          ContactLosses &losses, std::vector<BegunContact<GrainSurface>> &begun)
{
  const ContactScene &scene = context.scene;
  std::optional<PartLook> seen;
  for (std::size_t k = 0; k < searches.size(); ++k)
  {
    ContactSearch &search = searches[k];
    const FeatureOfSurface f = feature_of(scene.surfaces, search.second);
    const Surface &surface = scene.surfaces[f.surface];
    if (!seen || !seen->is_of(search, surface))
      seen.emplace(search, scene.particles, surface);
    SurfaceLook &look = seen->look;
    std::optional<SurfacePlace> place = look.place_at(f.feature, f.number);
    const bool keeps_shape = surface.is_at_rest() || surface.is_rigid;
    if (place && search.slot < 0 && !keeps_shape && !may_begin(*place, look, f.surface, search, context))
      place.reset();
    search.is_touching = place.has_value();
    if (!place)
    {
      const SeparatingDirection apart = look.separation_from(f.feature, f.number);
      context.hint[search.pair] = {apart, search, scene};
      if (apart.gap > 0.)
        search.gap = apart.gap;
      else if (is_guarded(search, context, look))
        search.gap = std::numeric_limits<double>::infinity();
      continue;
    }
    ContactLosses lost;
    State state = search.slot >= 0 ? context.store.get(search.slot) : State::begin();
    const double weight = place->index * scene.particles.weight[search.first];
    const Vec3 point = place->arm + 0.5 * place->overlap * place->normal;
    const FeatureMotion<double> motion = motion_of(search.first, search.second, scene, point);
    if (search.slot < 0)
      if (const auto other = taken_over(search, context, *place, look))
      {
        // It goes on from the other's state, which ends or stays by its own books: their end is taken back.
        state = *other;
        state.weight = weight;
        state.friction_work = 0.;
        ContactState<double> ended = state;
        ended.point = point;
        lost += end_of(ended, motion) * -1.;
      }
    take_flat_place(search, scene, {-place->normal, place->overlap, weight}, motion, state, lost);
    state.friction_work += lost.friction;
    losses += lost;
    // On a face the deepest point may go half the way to the nearest edge before it is looked at again.
    constexpr double share = 0.5;
    constexpr double not_followed = 1e100; // [1/m]
    const bool is_followed = f.feature == Feature::face && keeps_shape;
    const double way = is_followed ? share * look.distance_to_edges(f.number) : 0.;
    state.radii2.r11 = way > 0. ? std::min(1. / way, not_followed) : not_followed;
    if (!(way > 0.))
      state.budget = -1.; // also where nothing moves
    if (search.slot >= 0)
      context.store.set(search.slot, state);
    else
      begun.push_back({k, state});
  }
}

ContactLosses GrainSurface::end(const ContactSearch &search, const State &state, const ContactScene &scene)
{
  return end_of(state, motion_of(search.first, search.second, scene, state.point));
}

void GrainSurface::refresh(Store &store, const Particles &)
{
  search_all_anew(store);
}

TouchingContact GrainSurface::view(const ContactSearch &place, const State &state, const Particles &)
{
  TouchingContact contact{place.first, no_grain, view_of(state), state.point, own_image};
  contact.feature = place.second;
  return contact;
}

} // namespace bergamo::dem
