#include "dem/force/search_contacts.h"

#include "dem/core/rotation_matrix.h"
#include "dem/force/pair_motion.h"
#include "dem/force/searched_contact.h"
#include "dem/geometry/pair_search.h"
#include "dem/geometry/turn_wear.h"

#include <algorithm>
#include <array>

namespace bergamo::dem
{
namespace
{

/// Poses of the parts of all lanes. @param arm centres of the parts minus those of their particles [m], where any
/// particle has more than one part
template <class Part, class Index>
Pose<Pack> gather_pose(const Particles &p, const Part &part, const Index &particle, Vector3<Pack> &arm)
{
  const auto load = [&](const auto &number)
  { return math::generate<Pack>([&](const int lane) -> double { return number(lane); }); };
  const std::vector<Superquadric> &shapes = p.parts.shape;
  const SupportShape<Pack> shape(load([&](const int lane) { return shapes[part(lane)].half_axes[0]; }),
                                 load([&](const int lane) { return shapes[part(lane)].half_axes[1]; }),
                                 load([&](const int lane) { return shapes[part(lane)].half_axes[2]; }),
                                 load([&](const int lane) { return shapes[part(lane)].eps1; }),
                                 load([&](const int lane) { return shapes[part(lane)].eps2; }));
  if (p.has_clumps())
  {
    std::array<Quaternion, pack_width> turn;
    std::array<Vec3, pack_width> place;
    for (int lane = 0; lane < pack_width; ++lane)
    {
      turn[lane] = p.part_orientation(part(lane));
      place[lane] = p.orientation[particle(lane)] * p.parts.place[part(lane)];
    }
    arm = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return place[lane]; });
    const Pack x = load([&](const int lane) { return turn[lane].x(); }),
               y = load([&](const int lane) { return turn[lane].y(); }),
               z = load([&](const int lane) { return turn[lane].z(); }),
               w = load([&](const int lane) { return turn[lane].w(); });
    return {shape, rotation_matrix(x, y, z, w),
            math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.position[particle(lane)]; }) +
                arm};
  }
  const Pack x = load([&](const int lane) { return p.orientation[particle(lane)].x(); }),
             y = load([&](const int lane) { return p.orientation[particle(lane)].y(); }),
             z = load([&](const int lane) { return p.orientation[particle(lane)].z(); }),
             w = load([&](const int lane) { return p.orientation[particle(lane)].w(); });
  return {shape, rotation_matrix(x, y, z, w),
          math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.position[particle(lane)]; })};
}

/// Share of the contact in the virtual work: interpolated along the line of centres, Wellmann (6.29), and held between
/// the weights of the particles where the contact lies beside that line. With a particle of weight 1 it counts wholly:
/// such a particle may lie where no other model does, which could take a transfer.
template <class Real>
Real contact_weight(const Real &weight1, const Real &weight2, const Vector3<Real> &centre_line,
                    const Vector3<Real> &arm1)
{
  const Real square = centre_line.squaredNorm(); // zero for particles at one place
  const Real along = math::select(square > Real(0.), Real(centre_line.dot(arm1) / square), Real(0.5));
  const Real fraction = math::clamp(along, Real(0.), Real(1.));
  const auto is_whole = weight1 == Real(1.) || weight2 == Real(1.);
  return math::select(is_whole, Real(1.), Real(weight1 + fraction * (weight2 - weight1)));
}

/// Searches of a group of pairs, and what they give beside the states of the contacts.
struct GroupOfSearches
{
  const std::span<ContactSearch> searches;
  const SearchContext<GrainGrain> &context;
  std::vector<Vec3> start = std::vector<Vec3>(searches.size(), Vec3::Zero()); ///< where those left open go on

  ContactLosses losses = {}; ///< with the weights [J]
  std::vector<BegunContact<GrainGrain>> begun = {};
};

enum class Effort
{
  one_evaluation, ///< what that does not decide stays as it is
  all
};

/// Normals to start from: those of last step's contacts. One that could not be followed turned too far for that, but a
/// turn by its radii of curvature still leads near.
Vector3<Pack> turned_normal(const ContactState<Pack> &s, const PairMotion<Pack> &motion)
{
  constexpr double too_far = 0.1; // [rad]
  const math::Mask<Pack> is_followed = s.budget > Pack(s.lost);
  if (!math::any(!is_followed))
    return s.normal;
  TangentFrameOf<Pack> frame;
  frame << s.axis, s.second_axis();
  const ContactTurn<Pack> turn = motion.turn(s, frame);
  const math::Mask<Pack> stays = is_followed || !(turn.tilt.squaredNorm() < Pack(too_far * too_far));
  return math::select<Pack>(stays, s.normal, TurnedFrame<Pack>(s.normal, frame, turn).normal);
}

/// Searches one pack. @param which of the group, at most pack_width; @return those that are not decided
std::vector<std::size_t> search_pack(GroupOfSearches &group, const std::span<const std::size_t> which,
                                     const Effort effort)
{
  const SearchContext<GrainGrain> &context = group.context;
  const ContactScene &scene = context.scene;
  const Particles &p = scene.particles;
  const int n = static_cast<int>(which.size());
  const auto search_of = [&](const int lane) -> ContactSearch & { return group.searches[which[lane < n ? lane : 0]]; };
  const auto first_part = [&](const int lane) { return search_of(lane).first_part; };
  const auto second_part = [&](const int lane) { return search_of(lane).second_part; };
  const auto first = [&](const int lane) { return search_of(lane).first; };
  const auto second = [&](const int lane) { return search_of(lane).second; };
  const auto image = [&](const int lane) { return search_of(lane).image; };
  const auto load = [&](const std::vector<double> &values, const auto &index)
  { return math::generate<Pack>([&](const int lane) { return values[index(lane)]; }); };

  // The states of last step; a pair without a contact gets one about to begin.
  ContactState<Pack> s = ContactState<Pack>::begin();
  for (int lane = 0; lane < pack_width; ++lane)
    if (const std::int32_t slot = search_of(lane).slot; slot >= 0)
      context.store.copy_lane(slot, s, lane);
  const PairMotion<Pack> motion(p, first, second, image, scene.time_step);
  Vector3<Pack> guess = turned_normal(s, motion);
  for (int lane = 0; lane < n; ++lane)
  {
    const Vec3 &start = group.start[which[lane]];
    for (int d = 0; d < 3; ++d)
      if (search_of(lane).slot < 0)
        guess[d][lane] = context.hint[search_of(lane).pair].direction[d];
      else if (effort == Effort::all)
        guess[d][lane] = start[d];
  }

  Vector3<Pack> part_arm1, part_arm2;
  const Pose<Pack> body1 = gather_pose(p, first_part, first, part_arm1);
  Pose<Pack> body2 = gather_pose(p, second_part, second, part_arm2);
  if (p.cell.is_periodic())
    body2.position +=
        math::gather_vectors<Pack>([&](const int lane) -> const Vec3 & { return p.cell.place[image(lane)]; });
  const double tolerance = scene.parameters.overlap_tolerance;
  std::vector<std::size_t> open;
  std::array<bool, pack_width> is_decided;
  is_decided.fill(true);
  FoundContacts<Pack> found;
  if (effort == Effort::all)
    found = search_pairs<Pack>(body1, body2, guess, n, tolerance);
  else
  {
    const FirstLook<Pack> look(body1, body2, guess, tolerance);
    found = look.found;
    for (int lane = 0; lane < n; ++lane)
      if (!math::lane(look.is_decided, lane))
      {
        is_decided[lane] = false;
        open.push_back(which[lane]);
        group.start[which[lane]] = math::lane<Pack>(look.next, lane);
      }
  }
  for (int lane = 0; lane < n; ++lane)
  {
    if (!is_decided[lane])
      continue;
    ContactSearch &search = search_of(lane);
    search.is_undecided = found.is_undecided[lane];
    search.is_touching = math::lane(found.overlap, lane) > 0.;
    search.gap = -math::lane(found.overlap, lane);
    if (!search.is_touching)
      context.hint[search.pair] = Separation(math::lane<Pack>(found.normal, lane), search.gap, search, scene);
  }
  if (!math::any(found.overlap > 0.))
    return open;

  const double bound = scene.parameters.curvature_bound;
  const RelativeCurvature<Pack> curvature = relative_curvature(
      found.frame, principal_radii(body1, found.normal, found.radii1), curvature_bounds(body1.shape, bound),
      principal_radii(body2, found.normal, found.radii2), curvature_bounds(body2.shape, bound));
  Vector3<Pack> point = (found.arm1 + found.arm2) * Pack(0.5);
  if (p.has_clumps())
    point += (part_arm1 + part_arm2) * Pack(0.5);
  const ContactState<Pack> before = s;
  place_contact(s, found.normal, point, found.overlap, curvature, scene.law.elastic);
  const Pack half_overlap = found.overlap * Pack(0.5);
  s.radii1 = seen_from(s.axis, found.frame, found.radii1);
  s.radii2 = seen_from(s.axis, found.frame, found.radii2);
  TangentFrameOf<Pack> frame;
  frame << s.axis, s.second_axis();
  const Pack error = error_of_following(scene.parameters, found.overlap);
  give_budget<Pack>(s, scene.parameters, {RadiiChange<Pack>(body1, found.normal, found.arm1), frame, s.radii1, error},
                    {RadiiChange<Pack>(body2, found.normal, found.arm2), frame, s.radii2, error});
  s.radii1 = s.radii1 - half_overlap;
  s.radii2 = s.radii2 - half_overlap;
  s.weight = contact_weight<Pack>(load(p.weight, first), load(p.weight, second), motion.half_line * Pack(2.),
                                  s.point + motion.half_line);
  const Pack mass1 = load(p.mass, first), mass2 = load(p.mass, second);
  s.reduced_mass = 1. / (1. / mass1 + 1. / mass2);

  Losses<Pack> lost;
  take_search(s, before, motion, scene, lost);
  const Vector3<Pack> force = s.force();
  const Vector3<Pack> torque1 = (motion.half_line + s.point).cross(force),
                      torque2 = (motion.half_line - s.point).cross(force);
  for (int lane = 0; lane < n; ++lane)
  {
    ContactSearch &search = search_of(lane);
    if (!is_decided[lane] || !search.is_touching)
      continue;
    group.losses += lost.of_lane(lane);
    search.resultant = {math::lane<Pack>(force, lane), math::lane<Pack>(torque1, lane),
                        math::lane<Pack>(torque2, lane)};
    if (search.slot >= 0)
      context.store.take_lane(search.slot, s, lane);
    else
      group.begun.push_back({which[lane], lane_of(s, lane)});
  }
  return open;
}

/// Fetches the contacts of some searches ahead. Inlined by force, as in follow.cc.
BERGAMO_INLINE void prefetch(const GroupOfSearches &group, const std::span<const std::size_t> which)
{
  std::int32_t last_block = -1;
  for (const std::size_t k : which)
    if (const std::int32_t slot = group.searches[k].slot; slot >= 0)
      if (const std::int32_t block = slot / pack_width; block != last_block)
      {
        group.context.store.prefetch(block);
        last_block = block;
      }
}

} // namespace

void search_contacts(const std::span<ContactSearch> searches, const SearchContext<GrainGrain> &context,
                     ContactLosses &losses, std::vector<BegunContact<GrainGrain>> &begun)
{
  // Most are decided by one evaluation; the others go on together, in packs of their own, with those never searched.
  GroupOfSearches group{searches, context};
  const auto search_all = [&](const std::vector<std::size_t> &which, const Effort effort)
  {
    const auto pack_from = [&](const std::size_t from)
    {
      const std::size_t begin = std::min(from, which.size());
      return std::span(which).subspan(begin, std::min<std::size_t>(pack_width, which.size() - begin));
    };
    std::vector<std::size_t> open;
    prefetch(group, pack_from(0));
    for (std::size_t from = 0; from < which.size(); from += pack_width)
    {
      prefetch(group, pack_from(from + pack_width));
      const std::vector<std::size_t> left = search_pack(group, pack_from(from), effort);
      open.insert(open.end(), left.begin(), left.end());
    }
    return open;
  };
  std::vector<std::size_t> known, open;
  for (std::size_t k = 0; k < searches.size(); ++k)
    (searches[k].slot >= 0 || !context.hint[searches[k].pair].direction.isZero() ? known : open).push_back(k);
  const std::vector<std::size_t> left = search_all(known, Effort::one_evaluation);
  open.insert(open.end(), left.begin(), left.end());
  search_all(open, Effort::all);
  losses += group.losses;
  std::sort(group.begun.begin(), group.begun.end(), [](const auto &a, const auto &b) { return a.search < b.search; });
  begun.insert(begun.end(), group.begun.begin(), group.begun.end());
}

} // namespace bergamo::dem
