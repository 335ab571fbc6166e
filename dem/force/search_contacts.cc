#include "dem/force/search_contacts.h"

#include "dem/contact/common_normal.h"
#include "dem/contact/newton_search.h"
#include "dem/core/rotation_matrix.h"

namespace bergamo::dem
{
namespace
{

/// Evaluations after which the last open pairs of a pack are finished one by one.
constexpr int max_evaluations = 12;

template <class Real, class Index>
Pose<Real> gather_pose(const Particles &p, const Index &index)
{
  const auto load = [&](const auto &number)
  { return math::generate<Real>([&](const int lane) -> double { return number(index(lane)); }); };
  const SupportShape<Real> shape(load([&](const std::int32_t i) { return p.shape[i].half_axes[0]; }),
                                 load([&](const std::int32_t i) { return p.shape[i].half_axes[1]; }),
                                 load([&](const std::int32_t i) { return p.shape[i].half_axes[2]; }),
                                 load([&](const std::int32_t i) { return p.shape[i].eps1; }),
                                 load([&](const std::int32_t i) { return p.shape[i].eps2; }));
  const Real x = load([&](const std::int32_t i) { return p.orientation[i].x(); }),
             y = load([&](const std::int32_t i) { return p.orientation[i].y(); }),
             z = load([&](const std::int32_t i) { return p.orientation[i].z(); }),
             w = load([&](const std::int32_t i) { return p.orientation[i].w(); });
  return {shape, rotation_matrix(x, y, z, w),
          math::generate_vector<Real>([&](const int lane) -> const Vec3 & { return p.position[index(lane)]; })};
}

BodyPose pose_of(const Particles &p, const std::int32_t i)
{
  return make_pose(p.shape[i], p.position[i], p.orientation[i]);
}

/// One search beyond what the pack could decide.
ContactGeometry search_alone(const Particles &p, const ContactSearch &s)
{
  const BodyPose body1 = pose_of(p, s.first), body2 = pose_of(p, s.second);
  return s.guess.squaredNorm() > 0. ? update_contact(body1, body2, s.guess) : find_contact(body1, body2);
}

template <class Real>
void set_lane(Real &pack, const int lane, const double value)
{
  if constexpr (std::is_same_v<Real, double>)
    pack = value;
  else
    pack[static_cast<std::size_t>(lane)] = value;
}

template <class Real>
void set_lane(Vector3<Real> &pack, const int lane, const Vec3 &value)
{
  for (int d = 0; d < 3; ++d)
    set_lane(pack[d], lane, value[d]);
}

template <class Real>
void set_lane(CurvatureRadii<Real> &pack, const int lane, const CurvatureRadii<double> &value)
{
  set_lane(pack.r11, lane, value.r11);
  set_lane(pack.r22, lane, value.r22);
  set_lane(pack.r12, lane, value.r12);
}

/// States of several searches as one of packs, and back.
template <class Real>
ContactState<Real> gather_state(const std::span<const ContactSearch> searches)
{
  ContactState<Real> packed = ContactState<Real>::begin();
  constexpr std::size_t n_fields = sizeof(ContactState<double>) / sizeof(double);
  auto *target = reinterpret_cast<double *>(&packed);
  for (std::size_t lane = 0; lane < searches.size(); ++lane)
    for (std::size_t f = 0; f < n_fields; ++f)
      target[f * width<Real> + lane] = reinterpret_cast<const double *>(&searches[lane].state)[f];
  return packed;
}

template <class Real>
void scatter_state(const ContactState<Real> &packed, const std::size_t lane, ContactState<double> &state)
{
  constexpr std::size_t n_fields = sizeof(ContactState<double>) / sizeof(double);
  const auto *source = reinterpret_cast<const double *>(&packed);
  for (std::size_t f = 0; f < n_fields; ++f)
    reinterpret_cast<double *>(&state)[f] = source[f * width<Real> + lane];
}

/// Share of the contact in the virtual work: interpolated along the line of centres, Wellmann (6.29), and held between
/// the weights of the particles where the contact lies beside that line.
template <class Real>
Real contact_weight(const Real &weight1, const Real &weight2, const Vector3<Real> &centre_line,
                    const Vector3<Real> &arm1)
{
  const Real fraction = math::clamp(Real(centre_line.dot(arm1) / centre_line.squaredNorm()), Real(0.), Real(1.));
  return weight1 + fraction * (weight2 - weight1);
}

} // namespace

template <class Real>
void search_contacts(const std::span<ContactSearch> searches, const Particles &p, const ContactLaw &law,
                     const ContactParameters &parameters, const double time_step, ContactLosses &losses)
{
  const int n = static_cast<int>(searches.size());
  const auto search_of = [&](const int lane) -> const ContactSearch & { return searches[lane < n ? lane : 0]; };
  const auto first = [&](const int lane) { return search_of(lane).first; };
  const auto second = [&](const int lane) { return search_of(lane).second; };
  const auto load = [&](const auto &number)
  { return math::generate<Real>([&](const int lane) -> double { return number(search_of(lane)); }); };

  const Pose<Real> body1 = gather_pose<Real>(p, first), body2 = gather_pose<Real>(p, second);
  const Vector3<Real> centre_line = body2.position - body1.position;
  const Vector3<Real> guess =
      math::generate_vector<Real>([&](const int lane) -> const Vec3 & { return search_of(lane).guess; });
  const Real guess_square = guess.squaredNorm();
  const auto is_known = guess_square > Real(0.);
  const Vector3<Real> start = math::select<Real>(is_known, Vector3<Real>(guess / math::sqrt(guess_square)),
                                                 Vector3<Real>(centre_line / centre_line.norm()));
  NewtonSearch<Real> search(body1, body2, start);
  search.run(max_evaluations);

  Evaluation<Real> &found = search.best;
  const auto is_doubtful = search.is_open || (!is_known && found.phi > Real(0.) && is_suspicious(search));
  Vector3<Real> arm2 = found.arm1 + found.gap - centre_line;
  for (int lane = 0; lane < n; ++lane)
    if (math::lane(is_doubtful, lane))
    {
      const ContactGeometry alone = search_alone(p, searches[lane]);
      set_lane(found.c, lane, alone.normal);
      set_lane(found.phi, lane, alone.overlap);
      set_lane(found.arm1, lane, alone.arm1);
      set_lane(arm2, lane, alone.arm2);
      set_lane(found.radii1, lane, alone.radii1);
      set_lane(found.radii2, lane, alone.radii2);
      searches[lane].is_undecided = alone.status == ContactStatus::undecided;
    }
  for (int lane = 0; lane < n; ++lane)
  {
    searches[lane].is_touching = math::lane(found.phi, lane) > 0.;
    searches[lane].guess = math::lane<Real>(found.c, lane);
    searches[lane].gap = -math::lane(found.phi, lane);
  }
  const auto is_touching = found.phi > Real(0.);
  if (!math::any(is_touching))
    return;

  const PairMotion<Real> motion(p, first, second, time_step);
  const RelativeCurvature<Real> curvature = relative_curvature(
      tangent_frame(found.c), found.radii1, curvature_bounds(body1.shape, parameters.curvature_bound), found.radii2,
      curvature_bounds(body2.shape, parameters.curvature_bound));
  ContactState<Real> s = gather_state<Real>(searches);
  const Real old_overlap = s.overlap;
  s.spin += motion.turn_about(s.normal);
  const ContactState<Real> before = s;
  take_geometry(s, found.c, found.phi, curvature, law.elastic);
  s.point = (found.arm1 + arm2) * Real(0.5);
  const Real weight1 = load([&](const ContactSearch &c) { return p.weight[c.first]; });
  const Real weight2 = load([&](const ContactSearch &c) { return p.weight[c.second]; });
  s.weight = contact_weight<Real>(weight1, weight2, centre_line, s.point + centre_line * Real(0.5));
  const Real mass1 = load([&](const ContactSearch &c) { return p.mass[c.first]; });
  const Real mass2 = load([&](const ContactSearch &c) { return p.mass[c.second]; });
  s.reduced_mass = mass1 * mass2 / (mass1 + mass2);
  s.radius = math::min(load([&](const ContactSearch &c) { return p.bounding_radius[c.first]; }),
                       load([&](const ContactSearch &c) { return p.bounding_radius[c.second]; }));
  s.budget = motion_budget(parameters, s.radius, s.overlap, (found.radii1 + found.radii2).norm());

  Losses<Real> lost;
  lost.curvature = curvature_work(before, s, old_overlap);
  const Vector3<Real> force = advance_contact(s, law, old_overlap, motion.displacement(s.point), time_step, lost);
  store_resultants<Real>(force, s.point, motion.half_line,
                         [&](const int lane)
                         {
                           const bool is_wanted = lane < n && searches[lane].is_touching;
                           return is_wanted ? &searches[lane].resultant : nullptr;
                         });
  for (int lane = 0; lane < n; ++lane)
    if (searches[lane].is_touching)
    {
      scatter_state(s, lane, searches[lane].state);
      losses += ContactLosses{math::lane(lost.friction, lane), math::lane(lost.viscous, lane),
                              math::lane(lost.curvature, lane)};
    }
}

template void search_contacts<double>(std::span<ContactSearch>, const Particles &, const ContactLaw &,
                                      const ContactParameters &, double, ContactLosses &);
template void search_contacts<Pack>(std::span<ContactSearch>, const Particles &, const ContactLaw &,
                                    const ContactParameters &, double, ContactLosses &);

} // namespace bergamo::dem
