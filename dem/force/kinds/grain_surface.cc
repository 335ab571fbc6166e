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

/// Of a surface that has moved: what touched halfway has gone on with it since, by half of the slip.
/// @param place of the contact [m]; @param velocity of the grain [m/s]
template <class Real>
Vector3<Real> velocity_seen(const FeatureField<Real> &surface, const Vector3<Real> &place,
                            const Vector3<Real> &velocity, const double time_step)
{
  const Vector3<Real> slip = surface.velocity_at(place) - velocity;
  return surface.velocity_at(place + slip * Real(0.5 * time_step)) - velocity;
}

/// @param grain a particle; @param point of the contact minus the grain's centre [m]
FeatureMotion<double> motion_of(const std::int32_t grain, const FeatureOfSurface &f, const ContactScene &scene,
                                const Vec3 &point)
{
  const Particles &p = scene.particles;
  const Surface &surface = scene.surfaces[f.surface];
  FeatureMotion<double> motion;
  motion.velocity = -p.drift_velocity[grain];
  motion.spin = p.angular_velocity[grain];
  motion.time_step = scene.time_step;
  motion.feature_spin = Vec3::Zero();
  if (!surface.is_at_rest())
  {
    const FeatureField<double> field = surface.field_of(f);
    motion.velocity = velocity_seen<double>(field, p.position[grain] + point, p.drift_velocity[grain], scene.time_step);
    motion.feature_spin = field.spin;
  }
  motion.edge = f.feature == Feature::edge ? surface.direction_of_edge(f.number) : Vec3(Vec3::Zero());
  motion.is_face = f.feature == Feature::face;
  motion.is_edge = f.feature == Feature::edge;
  return motion;
}

/// As motion_of(), for a block of contacts. Most are on faces: those go by packs.
class BlockMotion
{
public:
  BlockMotion(const GrainSurface::Store &store, const std::size_t block, const ContactScene &scene) : scene(scene)
  {
    grain.fill(-1);
    for (int lane = 0; lane < pack_width; ++lane)
    {
      const std::size_t slot = block * pack_width + lane;
      if (store.pair[slot] == GrainSurface::Store::free_slot)
        continue;
      grain[lane] = store.first[slot];
      feature[lane] = feature_of(scene.surfaces, store.second[slot]);
      moves = moves || !surface_of(lane).is_at_rest();
      beside_faces = beside_faces || feature[lane].feature != Feature::face;
    }
  }

  /// @param point of the contacts minus the grains' centres [m]
  FeatureMotion<Pack> at(const Vector3<Pack> &point) const
  {
    const Particles &p = scene.particles;
    const Vector3<Pack> velocity = of_grains(p.drift_velocity), none = math::gather_vectors<Pack>(nothing);
    FeatureMotion<Pack> motion{
        {-velocity, of_grains(p.angular_velocity), scene.time_step}, none, none, Pack(1.), Pack(0.)};
    if (moves)
    {
      const FeatureField<Pack> field = of_surfaces();
      motion.velocity = velocity_seen<Pack>(field, of_grains(p.position) + point, velocity, scene.time_step);
      motion.feature_spin = field.spin;
    }
    if (beside_faces)
      for (int lane = 0; lane < pack_width; ++lane)
        if (is_taken(lane) && feature[lane].feature != Feature::face)
          set_lane(motion, lane, math::lane<Pack>(point, lane));
    return motion;
  }

private:
  static const Vec3 &nothing(int)
  {
    static const Vec3 zero = Vec3::Zero();
    return zero;
  }

  bool is_taken(const int lane) const { return grain[lane] >= 0; }
  const Surface &surface_of(const int lane) const { return scene.surfaces[feature[lane].surface]; }

  Vector3<Pack> of_grains(const std::vector<Vec3> &values) const
  {
    return math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                      { return is_taken(lane) ? values[grain[lane]] : nothing(lane); });
  }

  /// Of the faces; a free lane has some triangle that rests.
  FeatureField<Pack> of_surfaces() const
  {
    static const std::array<Vec3, 3> some{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()};
    std::array<Vector3<Pack>, 3> node, velocity;
    for (int k = 0; k < 3; ++k)
    {
      const auto number = [&](const int lane)
      { return surface_of(lane).topology.triangle[surface_of(lane).face_of(feature[lane])][k]; };
      node[k] = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                           { return is_taken(lane) ? surface_of(lane).node[number(lane)] : some[k]; });
      velocity[k] = math::gather_vectors<Pack>(
          [&](const int lane) -> const Vec3 &
          {
            return is_taken(lane) && !surface_of(lane).is_at_rest() ? surface_of(lane).drift_velocity[number(lane)]
                                                                    : nothing(lane);
          });
    }
    return FacePlane<Pack>(node).field(node, velocity);
  }

  void set_lane(FeatureMotion<Pack> &motion, const int lane, const Vec3 &point) const
  {
    const FeatureMotion<double> one = motion_of(grain[lane], feature[lane], scene, point);
    for (int d = 0; d < 3; ++d)
    {
      motion.velocity[d][lane] = one.velocity[d];
      motion.feature_spin[d][lane] = one.feature_spin[d];
      motion.edge[d][lane] = one.edge[d];
    }
    motion.is_face[lane] = one.is_face;
    motion.is_edge[lane] = one.is_edge;
  }

  const ContactScene &scene;
  std::array<std::int32_t, pack_width> grain; // -1: a free lane
  std::array<FeatureOfSurface, pack_width> feature;
  bool moves = false, beside_faces = false;
};

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
  const FeatureMotion<Pack> motion = BlockMotion(store, block, scene).at(state.point);
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
    const FeatureMotion<double> motion = motion_of(search.first, f, scene, point);
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
  return end_of(state, motion_of(search.first, feature_of(scene.surfaces, search.second), scene, state.point));
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
