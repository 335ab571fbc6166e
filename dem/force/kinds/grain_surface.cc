#include "dem/force/kinds/grain_surface.h"

#include "dem/force/follow.h"
#include "dem/force/kinds/against_flat.h"
#include "dem/force/searched_contact.h"

#include <cmath>
#include <limits>
#include <optional>

namespace bergamo::dem
{
namespace
{

/// As WallMotion; what the deepest point has come nearer to the edges of its face since the last search wears, too.
template <class Real>
struct FaceMotion : WallMotion<Real>
{
  ContactTurn<Real> turn(const ContactState<Real> &s, const TangentFrameOf<Real> &frame) const
  {
    ContactTurn<Real> turn = WallMotion<Real>::turn(s, frame);
    const Vector2<Real> slip = in_frame(frame, Vector3<Real>(turn.shift - this->velocity * Real(this->time_step)));
    turn.wear += math::sqrt(slip.squaredNorm()) * s.radii2.r11; // the inverse of what it may go
    return turn;
  }
};

/// Velocity of a surface where a contact is [m/s].
Vec3 velocity_at(const Surface &surface, const FeatureOfSurface &f, const Vec3 &point)
{
  return surface.is_at_rest() ? Vec3(Vec3::Zero())
                              : node_shares(surface, f.feature, f.number, point).of(surface.drift_velocity);
}

FaceMotion<double> motion_of(const ContactSearch &search, const ContactScene &scene, const Vec3 &point)
{
  const Particles &p = scene.particles;
  const FeatureOfSurface f = feature_of(scene.surfaces, search.second);
  const Vec3 velocity = velocity_at(scene.surfaces[f.surface], f, p.position[search.first] + point);
  return {velocity - p.drift_velocity[search.first], p.angular_velocity[search.first], scene.time_step};
}

/// The touching contact of the same part that a new one takes over from: the nearest in direction, about as deep.
std::optional<ContactState<double>> taken_over(const ContactSearch &search, const SearchContext<GrainSurface> &context,
                                               const SurfacePlace &place, SurfaceLook &look)
{
  constexpr double largest_turn_of_normal = 0.5; // [rad]: over an edge the normal turns with the part
  constexpr double depth_range = 2.;
  std::optional<ContactState<double>> found;
  double nearest = std::cos(largest_turn_of_normal);
  const std::int32_t surface = feature_of(context.scene.surfaces, search.second).surface;
  for (auto pair = context.list.row[search.first_part]; pair < context.list.row[search.first_part + 1]; ++pair)
  {
    const FeatureOfSurface f = feature_of(context.scene.surfaces, context.list.second[pair]);
    if (context.slot[pair] < 0 || f.surface != surface || !(look.overlap_at(f.feature, f.number) > 0.))
      continue;
    const ContactState<double> other = context.store.get(context.slot[pair]);
    const double alike = -other.normal.dot(place.normal), ratio = place.overlap / other.overlap;
    if (alike <= nearest || ratio > depth_range || ratio * depth_range < 1.)
      continue;
    nearest = alike;
    found = other;
  }
  return found;
}

/// Whether a feature that the part reaches without a place there cannot get one before a contact of the same part is
/// searched: one on a face that leans no more against it than what is followed at once, so that the deepest points on
/// both move alike, and where it lies further from any border than that contact may go.
bool is_guarded(const ContactSearch &search, const SearchContext<GrainSurface> &context, SurfaceLook &look)
{
  constexpr double safety = 1.2;
  const FeatureOfSurface f = feature_of(context.scene.surfaces, search.second);
  if (!context.scene.surfaces[f.surface].is_at_rest() || look.index_of(f.feature, f.number) != 0)
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
  const Particles &p = scene.particles;
  const auto grain = [&](const int lane) { return store.first[block * pack_width + lane]; };
  ContactState<Pack> &state = store.blocks[block];
  std::array<Vec3, pack_width> surface_velocity;
  surface_velocity.fill(Vec3::Zero());
  for (int lane = 0; lane < pack_width; ++lane)
  {
    const std::size_t slot = block * pack_width + lane;
    if (store.pair[slot] == Store::free_slot)
      continue;
    const FeatureOfSurface f = feature_of(scene.surfaces, store.second[slot]);
    if (scene.surfaces[f.surface].is_at_rest())
      continue;
    const Vec3 point = p.position[grain(lane)] + math::lane<Pack>(state.point, lane);
    surface_velocity[lane] = velocity_at(scene.surfaces[f.surface], f, point);
    state.budget[lane] = -1.; // its face turns
  }
  const FaceMotion<Pack> motion{
      {math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return surface_velocity[lane]; }) -
           math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.drift_velocity[grain(lane)]; }),
       math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.angular_velocity[grain(lane)]; }),
       scene.time_step}};
  const Followed<Pack> followed = follow(state, motion, scene.law, losses);
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
    const std::optional<SurfacePlace> place = look.place_at(f.feature, f.number);
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
    State state = search.slot >= 0 ? context.store.get(search.slot) : State::begin();
    const double weight = place->index * scene.particles.weight[search.first];
    const Vec3 point = place->arm + 0.5 * place->overlap * place->normal;
    const FaceMotion<double> motion = motion_of(search, scene, point);
    if (search.slot < 0)
      if (const auto other = taken_over(search, context, *place, look))
      {
        // It goes on from the other's state, which ends or stays by its own books: their end is taken back.
        state = *other;
        state.weight = weight;
        ContactState<double> ended = state;
        ended.point = point;
        losses += end_of(ended, motion) * -1.;
      }
    take_flat_place(search, scene, {-place->normal, place->overlap, weight}, motion, state, losses);
    // On a face at rest the deepest point may go half the way to the nearest edge before it is looked at again.
    constexpr double share = 0.5;
    constexpr double not_followed = 1e100; // [1/m]
    const bool is_followed = f.feature == Feature::face && surface.is_at_rest();
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
  return end_of(state, motion_of(search, scene, state.point));
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
