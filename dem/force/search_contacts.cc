#include "dem/force/search_contacts.h"

#include "dem/contact/pair_search.h"

namespace bergamo::dem
{
namespace
{

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
  const Real two(2.), one(1.);
  Matrix3<Real> r;
  r(0, 0) = one - two * (y * y + z * z);
  r(0, 1) = two * (x * y - w * z);
  r(0, 2) = two * (x * z + w * y);
  r(1, 0) = two * (x * y + w * z);
  r(1, 1) = one - two * (x * x + z * z);
  r(1, 2) = two * (y * z - w * x);
  r(2, 0) = two * (x * z - w * y);
  r(2, 1) = two * (y * z + w * x);
  r(2, 2) = one - two * (x * x + y * y);
  return {shape, r,
          math::generate_vector<Real>([&](const int lane) -> const Vec3 & { return p.position[index(lane)]; })};
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
  const FoundContacts<Real> found = search_pairs<Real>(body1, body2, guess, n);
  for (int lane = 0; lane < n; ++lane)
  {
    searches[lane].is_undecided = found.is_undecided[lane];
    searches[lane].is_touching = math::lane(found.overlap, lane) > 0.;
    searches[lane].guess = math::lane<Real>(found.normal, lane);
    searches[lane].gap = -math::lane(found.overlap, lane);
  }
  const auto is_touching = found.overlap > Real(0.);
  if (!math::any(is_touching))
    return;

  const PairMotion<Real> motion(p, first, second, time_step);
  const RelativeCurvature<Real> curvature = relative_curvature(
      tangent_frame(found.normal), found.radii1, curvature_bounds(body1.shape, parameters.curvature_bound),
      found.radii2, curvature_bounds(body2.shape, parameters.curvature_bound));
  ContactState<Real> s = gather_state<Real>(searches);
  const Real old_overlap = s.overlap;
  s.spin += motion.turn_about(s.normal);
  const ContactState<Real> before = s;
  take_geometry(s, found.normal, found.overlap, curvature, law.elastic);
  s.point = (found.arm1 + found.arm2) * Real(0.5);
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
