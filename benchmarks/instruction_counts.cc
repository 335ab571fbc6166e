// One hot kernel on fixed seeded grains, so that its instructions can be counted: benchmarks/instruction_counts.py runs
// this program under callgrind with one pass and with two, and takes the difference.
//
// Usage: instruction_counts KERNEL PASSES; prints the items (contacts, pairs, grains, elements) of one pass and the
// compiler.
//        instruction_counts                prints the kernels

#include "dem/force/contacts.h"
#include "dem/force/follow.h"
#include "dem/force/search_contacts.h"
#include "dem/geometry/common_normal.h"
#include "dem/geometry/newton_search.h"
#include "dem/geometry/pose_lanes.h"
#include "dem/motion/leapfrog.h"
#include "dem/packing/distribution.h"
#include "fe_dealii/element/bending_hexahedron.h"
#include "fe_dealii/element/hexahedron.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{

using namespace bergamo;
using namespace bergamo::dem;

constexpr int n_pairs = 64, n_packs = n_pairs / pack_width, n_grains = 2 * n_pairs;
constexpr double density = 2650., time_step = 1e-7;               // [kg/m^3], [s]
constexpr double smallest_overlap = 3e-8, largest_overlap = 3e-7; // [m]
constexpr double guess_error = 1e-4;                              // [rad]
const Vec3 gravity(0., 0., -9.81);
const ContactLaw law{elastic_pair(Material{}, Material{}), 0.5, 0.1, 0.};
const ContactParameters parameters;

enum class Grain
{
  sand,
  sphere
};

class Random
{
public:
  double operator()(const double low, const double high)
  {
    return std::uniform_real_distribution<double>(low, high)(generator);
  }
  Vec3 direction() { return draw_orientation(generator) * Vec3::UnitZ(); }
  Quaternion orientation() { return draw_orientation(generator); }
  Superquadric shape(const Grain grain)
  {
    Superquadric s = draw_grain({}, generator);
    return grain == Grain::sand ? s : Superquadric{Vec3::Constant(s.half_axes[1]), 1., 1.};
  }

private:
  std::mt19937_64 generator{1};
};

/// Slow enough that contacts stay closed, and that the motion of a step is small as in a simulation.
void set_in_motion(Particles &p, Random &random)
{
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    p.velocity[i] = p.drift_velocity[i] = random(0., 1e-3) * random.direction();
    p.angular_velocity[i] = random(0., 1.) * random.direction();
    p.angular_momentum[i] =
        p.orientation[i] * (p.orientation[i].conjugate() * p.angular_velocity[i]).cwiseProduct(p.inertia[i]);
    p.force[i] = random(0., 1e-3) * random.direction();
    p.torque[i] = random(0., 1e-7) * random.direction();
  }
}

Particles lone_grains(const Grain grain, Random &random)
{
  Particles p;
  for (int i = 0; i < n_grains; ++i)
    p.add(random.shape(grain), density, Vec3::Zero(), random.orientation());
  set_in_motion(p, random);
  return p;
}

/// Pairs of grains (2 k, 2 k + 1) that touch, and the normals of their contacts.
struct TouchingPairs
{
  Particles particles;
  std::vector<Vec3> normal;

  TouchingPairs(const Grain grain, Random &random)
  {
    while (static_cast<int>(normal.size()) < n_pairs)
    {
      const Superquadric shape1 = random.shape(grain), shape2 = random.shape(grain);
      const Quaternion turn1 = random.orientation(), turn2 = random.orientation();
      const BodyPose body1 = make_pose(shape1, Vec3::Zero(), turn1);
      BodyPose body2 = make_pose(shape2, Vec3::Zero(), turn2);
      const Vec3 c = random.direction();
      const double overlap = random(smallest_overlap, largest_overlap);
      body2.position = support(body1, c).arm - support(body2, -c).arm - overlap * c;
      const ContactGeometry g = find_contact(body1, body2);
      if (g.overlap < 0.99 * overlap) // the contact is elsewhere
        continue;
      particles.add(shape1, density, body1.position, turn1);
      particles.add(shape2, density, body2.position, turn2);
      normal.push_back(g.normal);
    }
    set_in_motion(particles, random);
  }
};

Vec3 nearby(const Vec3 &normal, Random &random)
{
  const Vec3 tangent = normal.cross(random.direction()).normalized();
  return (normal + guess_error * tangent).normalized();
}

/// Searches of one pack of touching pairs.
class PairSearches
{
public:
  explicit PairSearches(Random &random) : pairs(Grain::sand, random), separation(n_pairs)
  {
    begun.reserve(n_pairs);
    for (int pair = 0; pair < n_pairs; ++pair)
      searches.push_back(
          {pair, 2 * pair, 2 * pair + 1, 2 * pair, 2 * pair + 1, own_image, ContactSet<GrainGrain>::apart});
  }

  void search_all()
  {
    const VerletList no_candidates; // asked for by kinds alone whose contacts take over from one another
    const std::vector<std::int32_t> no_slots;
    const ContactScene scene{pairs.particles, no_walls, law, parameters, time_step};
    const SearchContext<GrainGrain> context{scene, store, separation, no_candidates, no_slots};
    for (int pack = 0; pack < n_packs; ++pack)
    {
      const std::size_t n_begun = begun.size();
      search_contacts({&searches[pack * pack_width], pack_width}, context, losses, begun);
      for (std::size_t k = n_begun; k < begun.size(); ++k)
        begun[k].search += pack * pack_width;
    }
  }

  /// Gives a slot to every contact, in the order of the pairs.
  void take_begun()
  {
    search_all();
    if (begun.size() != n_pairs)
      std::abort();
    store.resize(n_pairs);
    for (const BegunContact<GrainGrain> &c : begun)
    {
      ContactSearch &s = searches[c.search];
      s.slot = s.pair;
      store.put(s.slot, {s.pair, s.first, s.second}, c.state);
    }
    begun.clear();
  }

  TouchingPairs pairs;
  const std::vector<PlaneWall> no_walls;
  ContactStore<ContactState> store;
  std::vector<Separation> separation;
  std::vector<ContactSearch> searches;
  std::vector<BegunContact<GrainGrain>> begun;
  ContactLosses losses;
};

template <class State>
void follow_pairs(State &store, const Particles &particles, const int passes)
{
  LoadSums loads;
  loads.list_bodies(store.first, store.second, particles.size());
  Losses<Pack> losses;
  for (int pass = 0; pass < passes; ++pass)
    for (int block = 0; block < n_packs; ++block)
      follow_block(store, loads, block, particles, law, time_step, losses);
}

int follow_contact(const int passes, Random &random)
{
  PairSearches s(random);
  s.take_begun();
  follow_pairs(s.store, s.pairs.particles, passes);
  return n_pairs;
}

int follow_sphere_contact(const int passes, Random &random)
{
  const TouchingPairs pairs(Grain::sphere, random);
  const Particles &p = pairs.particles;
  ContactStore<SphereContactState> store;
  store.resize(n_pairs);
  for (int pair = 0; pair < n_pairs; ++pair)
  {
    const int i = 2 * pair, j = i + 1;
    const double radius_sum = p.bounding_radius[i] + p.bounding_radius[j];
    const double overlap = radius_sum - (p.position[j] - p.position[i]).norm();
    const double curvature = 0.5 * (1. / p.bounding_radius[i] + 1. / p.bounding_radius[j]);
    const HertzMindlin<double> stiffness = hertz_mindlin(curvature, curvature, law.elastic);
    SphereContactState<double> state = SphereContactState<double>::idle();
    state.root_overlap = std::sqrt(overlap);
    state.radius_sum = radius_sum;
    state.radius_difference = p.bounding_radius[i] - p.bounding_radius[j];
    state.normal_stiffness = stiffness.normal;
    state.tangential_stiffness = stiffness.tangential_major;
    state.reduced_mass = 1. / (1. / p.mass[i] + 1. / p.mass[j]);
    state.weight = 1.;
    store.put(pair, {pair, i, j}, state);
  }
  follow_pairs(store, p, passes);
  return n_pairs;
}

int warm_search(const int passes, Random &random)
{
  PairSearches s(random);
  s.take_begun();
  std::vector<Vector3<Pack>> guess(n_packs);
  for (int pair = 0; pair < n_pairs; ++pair)
  {
    const Vec3 c = nearby(s.pairs.normal[pair], random);
    for (int d = 0; d < 3; ++d)
      guess[pair / pack_width][d][pair % pack_width] = c[d];
  }
  for (int pass = 0; pass < passes; ++pass)
  {
    for (int pack = 0; pack < n_packs; ++pack)
      s.store.blocks[pack].normal = guess[pack];
    s.search_all();
  }
  return n_pairs;
}

int cold_search(const int passes, Random &random)
{
  PairSearches s(random);
  for (int pass = 0; pass < passes; ++pass)
  {
    s.begun.clear();
    s.search_all();
  }
  return n_pairs;
}

Pose<Pack> packed_pose(const Particles &p, const int pack, const int body)
{
  Pose<Pack> packed = in_every_lane(make_pose({}, Vec3::Zero(), Quaternion::Identity()));
  auto *numbers = reinterpret_cast<double *>(&packed);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    const int i = 2 * (pack * pack_width + lane) + body;
    const BodyPose alone = make_pose(p.parts.shape[i], p.position[i], p.orientation[i]);
    const auto *source = reinterpret_cast<const double *>(&alone);
    for (std::size_t field = 0; field < sizeof(BodyPose) / sizeof(double); ++field)
      numbers[field * pack_width + lane] = source[field];
  }
  return packed;
}

[[gnu::noinline]] void evaluate(const Pose<Pack> &body1, const Pose<Pack> &body2, Evaluation<Pack> &e)
{
  e = Evaluation<Pack>(body1, body2, e.c);
}

int support_evaluation(const int passes, Random &random)
{
  const TouchingPairs pairs(Grain::sand, random);
  std::vector<Pose<Pack>> body1, body2;
  std::vector<Evaluation<Pack>> evaluations;
  for (int pack = 0; pack < n_packs; ++pack)
  {
    body1.push_back(packed_pose(pairs.particles, pack, 0));
    body2.push_back(packed_pose(pairs.particles, pack, 1));
    const Vector3<Pack> c = math::gather_vectors<Pack>([&](const int lane) -> const Vec3 &
                                                       { return pairs.normal[pack * pack_width + lane]; });
    evaluations.emplace_back(body1[pack], body2[pack], c);
  }
  for (int pass = 0; pass < passes; ++pass)
    for (int pack = 0; pack < n_packs; ++pack)
      evaluate(body1[pack], body2[pack], evaluations[pack]);
  return n_pairs;
}

int move(const Grain grain, const int passes, Random &random)
{
  Particles p = lone_grains(grain, random);
  for (int pass = 0; pass < passes; ++pass)
    if (!advance(p, {gravity}, time_step, time_step))
      std::abort();
  return n_grains;
}

int motion(const int passes, Random &random)
{
  return move(Grain::sand, passes, random);
}

int sphere_motion(const int passes, Random &random)
{
  return move(Grain::sphere, passes, random);
}

int sum_of_six_contacts(const int passes, Random &)
{
  // A ring, in which each grain touches the next three.
  constexpr int n_contacts = 3 * n_grains;
  std::vector<std::int32_t> first(n_contacts), second(n_contacts);
  for (int contact = 0; contact < n_contacts; ++contact)
  {
    first[contact] = contact / 3;
    second[contact] = (contact / 3 + contact % 3 + 1) % n_grains;
  }
  LoadSums sums;
  sums.list_bodies(first, second, n_grains);
  const Vector3<Pack> one(1., 1., 1.);
  BodyLoad total; // keeps the compiler from leaving the sums out
  for (int pass = 0; pass < passes; ++pass)
  {
    for (std::size_t chunk = 0; chunk < sums.n_chunks(); ++chunk)
      sums.start(chunk);
    for (int block = 0; block < n_contacts / pack_width; ++block)
      sums.add(block, one, one, one);
    for (int i = 0; i < n_grains; ++i)
      sums.add_load(i, total);
  }
  if (!total.torque.allFinite())
    std::abort();
  return n_grains;
}

/// Strains, stresses and nodal forces of elements of 8 nodes. Each pass takes them on by the same strain increment,
/// which is large enough for all points to flow if they can.
template <class Law>
int hexahedra(const Law &law, const int passes, Random &random)
{
  constexpr int n_elements = 32;
  struct Element
  {
    fe::hexahedron::Geometry geometry;
    fe::PointHistory history;
    double increment[fe::hexahedron::n_dofs], force[fe::hexahedron::n_dofs];
    fe::Sector sector[fe::hexahedron::n_points];
  };
  std::vector<Element> elements(n_elements);
  for (Element &e : elements)
  {
    e.geometry.volume_fraction = fe::Points(1. / fe::hexahedron::n_points);
    e.geometry.volume = e.geometry.share_volume = fe::Points(1e-3);
    for (auto &axis : e.geometry.gradient)
      for (fe::Points &gradient : axis)
        for (int point = 0; point < fe::hexahedron::n_points; ++point)
          gradient[point] = random(-10., 10.); // [1/m]
    for (double &displacement : e.increment)
      displacement = random(-1e-3, 1e-3); // [m]
    e.history = {};
  }
  for (int pass = 0; pass < passes; ++pass)
    for (Element &e : elements)
    {
      fe::Points strain[6];
      fe::hexahedron::strain(e.geometry, e.increment, strain);
      fe::update_stress(law, e.geometry.share_volume, strain, e.history, e.sector);
      fe::hexahedron::internal_force(e.geometry, e.history.stress, e.force);
      asm volatile("" : : "m"(e.force)); // somebody reads them
      for (const fe::Sector sector : e.sector)
        if (std::is_same_v<Law, fe::MohrCoulomb> && sector == fe::Sector::elastic)
          std::abort();
    }
  return n_elements;
}

/// The same of elements that bend, eight in a pack; without the gathering of their nodes.
int elastic_bending_hexahedron(const int passes, Random &random)
{
  constexpr int n_packs = 4;
  struct EightElements
  {
    fe::bending::Geometry<fe::Points> geometry;
    fe::PointHistory history;
    fe::Points increment[fe::bending::n_dofs], force[fe::bending::n_dofs], amplitude[fe::bending::n_modes][3];
  };
  std::vector<EightElements> packs(n_packs);
  const auto draw = [&](fe::Points &points, const double size)
  {
    for (int lane = 0; lane < fe::points_per_pack; ++lane)
      points[lane] = random(-size, size);
  };
  for (EightElements &e : packs)
  {
    e = {};
    e.geometry.volume = 1e-3;
    for (auto &axis : e.geometry.gradient)
      for (fe::Points &gradient : axis)
        draw(gradient, 10.);
    for (auto &mode : e.geometry.amplitude)
      for (fe::Points &amplitude : mode)
        draw(amplitude, 1.);
    for (fe::Points &stiffness : e.geometry.stiffness)
      draw(stiffness, 1e6);
    for (fe::Points &displacement : e.increment)
      draw(displacement, 1e-3);
  }
  const fe::LinearElastic law({.young_modulus = 60e6, .poisson_ratio = 0.15});
  for (int pass = 0; pass < passes; ++pass)
    for (EightElements &e : packs)
    {
      const fe::bending::Motion<fe::Points> motion = fe::bending::motion_of(e.geometry, e.increment);
      fe::Points strain[6], on_amplitude[fe::bending::n_modes][3];
      fe::bending::small_strain(motion.gradient, strain);
      fe::update_stress(law, e.geometry.volume, strain, e.history, nullptr);
      for (int mode = 0; mode < fe::bending::n_modes; ++mode)
        for (int i = 0; i < 3; ++i)
          e.amplitude[mode][i] += motion.amplitude[mode][i];
      fe::bending::hourglass_force(e.geometry, e.amplitude, on_amplitude);
      fe::bending::nodal_force(e.geometry, fe::bending::work_on_gradient(e.geometry, e.history.stress), on_amplitude,
                               e.force);
      asm volatile("" : : "m"(e.force)); // somebody reads them
    }
  return n_packs * fe::points_per_pack;
}

int elastic_hexahedron(const int passes, Random &random)
{
  return hexahedra(fe::LinearElastic({.young_modulus = 60e6, .poisson_ratio = 0.15}), passes, random);
}

int flowing_hexahedron(const int passes, Random &random)
{
  return hexahedra(fe::MohrCoulomb({}), passes, random);
}

struct Kernel
{
  const char *name;
  int (*run)(int passes, Random &random); ///< @return items of one pass
};
constexpr Kernel kernels[] = {
    {"follow_contact", follow_contact},
    {"follow_sphere_contact", follow_sphere_contact},
    {"warm_search", warm_search},
    {"cold_search", cold_search},
    {"support_evaluation", support_evaluation},
    {"motion", motion},
    {"sphere_motion", sphere_motion},
    {"sum_of_six_contacts", sum_of_six_contacts},
    {"elastic_hexahedron", elastic_hexahedron},
    {"flowing_hexahedron", flowing_hexahedron},
    {"elastic_bending_hexahedron", elastic_bending_hexahedron},
};

} // namespace

int main(const int argc, const char *const *argv)
{
  if (argc != 3)
  {
    for (const Kernel &kernel : kernels)
      std::puts(kernel.name);
    return argc == 1 ? 0 : 2;
  }
  for (const Kernel &kernel : kernels)
    if (std::strcmp(kernel.name, argv[1]) == 0)
    {
      Random random;
      const int items = kernel.run(std::atoi(argv[2]), random);
      std::printf("items %d\ncompiler g++ %s\npack_width %d\n", items, __VERSION__, pack_width);
      return 0;
    }
  std::fprintf(stderr, "no kernel is called %s\n", argv[1]);
  return 2;
}
