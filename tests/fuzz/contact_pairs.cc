// Fuzz target: bytes make a pair of grains of any shape and pose, touching or nearly so; whatever they are, the contact
// search must decide it, find the least minimum where the overlap is shallow, and be consistent. LLVMFuzzerTestOneInput
// is libFuzzer's entry (clang++ -fsanitize=fuzzer -DBERGAMO_LIBFUZZER); without it main() below draws random bytes:
//   contact_pairs [--runs N | --seconds S] [--seed N]      prints the first failing input in hex, ends with status 1
//   contact_pairs --input HEX                              runs that one again
//
// Shapes: exponents in [0.02, 1.98], ratios of half-axes up to 20; one in eight up to the limits of shapes. Overlaps
// and gaps are up to a tenth of the smallest half-axis. Special values (equal shapes, exact zeros, grains along the
// axes) are drawn often: that is where Newton's method meets symmetry, flat faces and kinks. One pair in sixteen shares
// its centre, or nearly so.

#include "dem/geometry/pair_search.h"
#include "tests/unit/dem_contact_reference.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <span>
#include <string>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;

namespace
{

/// Numbers from bytes; zeros when they are used up.
class Bytes
{
public:
  explicit Bytes(const std::span<const std::uint8_t> data) : data(data) {}

  int byte()
  {
    if (next == data.size())
      return 0;
    return data[next++];
  }
  /// In [0, 1], with both ends and the middle drawn often.
  double share()
  {
    const int kind = byte();
    if (kind < 16)
      return kind % 4 == 0 ? 0. : kind % 4 == 1 ? 1. : 0.5;
    return (256. * byte() + byte()) / 65535.;
  }
  double between(const double low, const double high) { return low + share() * (high - low); }

private:
  std::span<const std::uint8_t> data;
  std::size_t next = 0;
};

Superquadric shape_from(Bytes &bytes)
{
  const bool is_extreme = bytes.byte() % 8 == 1;
  const double ratio = is_extreme ? shape_limits::largest_ratio : 20.,
               margin = is_extreme ? shape_limits::smallest_exponent : 0.02;
  Superquadric s;
  for (double &r : s.half_axes)
    r = std::pow(ratio, -bytes.share());
  s.eps1 = bytes.between(margin, 2. - margin);
  s.eps2 = bytes.between(margin, 2. - margin);
  if (bytes.byte() % 4 == 0)
    s.eps2 = s.eps1;
  s.validate();
  return s;
}

Vec3 direction_from(Bytes &bytes)
{
  Vec3 v(bytes.between(-1., 1.), bytes.between(-1., 1.), bytes.between(-1., 1.));
  return v.norm() > 0. ? Vec3(v.normalized()) : Vec3(Vec3::UnitZ());
}

Quaternion orientation_from(Bytes &bytes)
{
  const int kind = bytes.byte() % 4;
  if (kind == 0)
    return Quaternion::Identity();
  const double angle = bytes.between(0., 3.14159265358979323846);
  if (kind == 1) // about a body axis
    return Quaternion(Eigen::AngleAxisd(angle, Vec3::Unit(bytes.byte() % 3)));
  return Quaternion(Eigen::AngleAxisd(kind == 2 ? angle : angle * 1e-6, direction_from(bytes)));
}

struct Pair
{
  Superquadric shape1, shape2;
  BodyPose body1, body2;
};

Pair pair_from(Bytes bytes)
{
  const Superquadric shape1 = shape_from(bytes);
  const Superquadric shape2 = bytes.byte() % 4 == 0 ? shape1 : shape_from(bytes);
  const Quaternion turn1 = orientation_from(bytes), turn2 = orientation_from(bytes);
  BodyPose body1 = make_pose(shape1, Vec3::Zero(), turn1), body2 = make_pose(shape2, Vec3::Zero(), turn2);
  const Vec3 c = direction_from(bytes);
  const double smallest = std::min(shape1.half_axes.minCoeff(), shape2.half_axes.minCoeff());
  const double size = smallest * 0.1 * std::pow(10., -6. * bytes.share());
  const double overlap = bytes.byte() % 3 == 0 ? -size : size;
  body2.position = support(body1, c).arm - support(body2, -c).arm - overlap * c;
  if (bytes.byte() % 4 == 0) // along a line through the centre of body 1
    body2.position = body2.position.cwiseProduct(Vec3::Unit(bytes.byte() % 3));
  if (bytes.byte() % 16 == 1)
    body2.position *= std::pow(10., -bytes.between(1., 330.)) * (bytes.byte() % 2);
  return {shape1, shape2, body1, body2};
}

double phi(const BodyPose &a, const BodyPose &b, const Vec3 &c)
{
  return support(a, c).height + support(b, -c).height - c.dot(b.position - a.position);
}

long n_unproven = 0; ///< pairs of which the reference does not know

/// What is wrong with the search of a pair, or nullptr.
const char *fault(const Pair &pair)
{
  const BodyPose &a = pair.body1, &b = pair.body2;
  const ContactGeometry g = find_contact(a, b);
  const double largest = std::max(pair.shape1.half_axes.maxCoeff(), pair.shape2.half_axes.maxCoeff());
  const double rounding = 1e-13 * (b.position.norm() + largest); // of phi
  const double tolerance = 1e-9 * std::min(pair.shape1.half_axes.minCoeff(), pair.shape2.half_axes.minCoeff());

  if (g.status == ContactStatus::undecided)
    return "undecided";
  if (!g.normal.allFinite() || !std::isfinite(g.overlap) || !g.arm1.allFinite() || !g.arm2.allFinite() ||
      !std::isfinite(g.radii1.norm()) || !std::isfinite(g.radii2.norm()))
    return "not finite";
  if (std::abs(g.normal.norm() - 1.) > 1e-14)
    return "normal not a unit vector";
  if ((g.status == ContactStatus::touching) != (g.overlap >= 0.))
    return "status and sign of the overlap differ";
  if (std::abs(phi(a, b, g.normal) - g.overlap) > rounding)
    return "overlap is not phi of the normal";
  if (g.status == ContactStatus::touching)
    for (int d = 0; d < 3; ++d)
      for (const Vec3 &axis : {Vec3(a.rotation.col(d)), Vec3(b.rotation.col(d)), Vec3(Vec3::Unit(d))})
        if (std::min(phi(a, b, axis), phi(a, b, -axis)) < g.overlap - tolerance)
          return "an axis has a smaller overlap";
  // Deeper, several minima are usual; the least one is found where it is easy.
  const bool is_shallow =
      g.overlap < 0.1 * std::min(pair.shape1.half_axes.minCoeff(), pair.shape2.half_axes.minCoeff());
  if (!is_shallow)
    return nullptr;
  if (g.status == ContactStatus::touching && g.overlap > tolerance)
  {
    const contact_reference::Verdict verdict = contact_reference::judge(a, b, g.overlap - tolerance).verdict;
    if (verdict == contact_reference::Verdict::lower)
      return "another direction has a smaller overlap";
    n_unproven += verdict == contact_reference::Verdict::unknown;
  }

  const auto differs = [&](const double overlap)
  {
    if (g.overlap < 0. && overlap < 0.) // gaps are bounds, not unique
      return false;
    return std::abs(overlap - g.overlap) > tolerance;
  };
  if (differs(find_contact(b, a).overlap))
    return "the exchanged pair differs";

  // In packs: this pair between its exchanged copies.
  const Pose<Pack> one = in_every_lane(a), other = in_every_lane(b);
  const Pack zero(0.);
  const FoundContacts<Pack> found = search_pairs<Pack>(one, other, {zero, zero, zero}, pack_width);
  for (int k = 0; k < pack_width; ++k)
    if (found.is_undecided[k] || differs(math::lane(found.overlap, k)))
      return "the search in packs differs";
  if (g.status == ContactStatus::touching)
  {
    const ContactGeometry again = update_contact(a, b, g.normal);
    if (again.status == ContactStatus::undecided || again.overlap > g.overlap + tolerance)
      return "the search from its own result loses it";
  }
  return nullptr;
}

std::string hex(const std::span<const std::uint8_t> data)
{
  std::string text;
  for (const std::uint8_t byte : data)
  {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

void describe(const Pair &p)
{
  for (const auto &[shape, body] : {std::pair(p.shape1, p.body1), std::pair(p.shape2, p.body2)})
  {
    std::printf("half-axes %.17g %.17g %.17g exponents %.17g %.17g position %.17g %.17g %.17g\n", shape.half_axes[0],
                shape.half_axes[1], shape.half_axes[2], shape.eps1, shape.eps2, body.position[0], body.position[1],
                body.position[2]);
    for (int i = 0; i < 3; ++i)
      std::printf("  %20.17f %20.17f %20.17f\n", body.rotation(i, 0), body.rotation(i, 1), body.rotation(i, 2));
  }
  const ContactGeometry g = find_contact(p.body1, p.body2), e = find_contact(p.body2, p.body1);
  NewtonSearch<double> search(p.body1, p.body2, p.body2.position.normalized());
  search.run(250);
  std::printf("from the centre line: overlap %.6e low/overlap %.3g\n", search.best.phi, search.low / search.best.phi);
  for (const auto &[r, name] : {std::pair(g, "found"), std::pair(e, "exchanged")})
    std::printf("%s: status %d overlap %.6e normal %.6g %.6g %.6g evaluations %d\n", name, static_cast<int>(r.status),
                r.overlap, r.normal[0], r.normal[1], r.normal[2], r.n_evaluations);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  if (const char *what = fault(pair_from(Bytes({data, size}))))
  {
    std::printf("%s: %s\n", what, hex({data, size}).c_str());
    std::abort();
  }
  return 0;
}

#ifndef BERGAMO_LIBFUZZER
int main(int argc, char **argv)
{
  long n_runs = 2000;
  double seconds = 0.;
  unsigned seed = 1;
  bool goes_on = false; // past failures: counts them
  for (int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    const char *value = i + 1 < argc ? argv[i + 1] : "0";
    if (option == "--keep-going")
    {
      goes_on = true;
      continue;
    }
    ++i;
    if (option == "--runs")
      n_runs = std::atol(value);
    else if (option == "--seconds")
      seconds = std::atof(value);
    else if (option == "--seed")
      seed = static_cast<unsigned>(std::atol(value));
    else if (option == "--input")
    {
      std::vector<std::uint8_t> data;
      for (std::size_t k = 0; k + 1 < std::strlen(value); k += 2)
        data.push_back(static_cast<std::uint8_t>(std::stoi(std::string(value + k, 2), nullptr, 16)));
      const Pair pair = pair_from(Bytes(data));
      const char *what = fault(pair);
      describe(pair);
      std::printf("%s\n", what ? what : "no fault");
      return what ? 1 : 0;
    }
    else
    {
      std::fprintf(stderr, "unknown option %s: use --runs, --seconds, --seed, --input, --keep-going\n", argv[i - 1]);
      return 2;
    }
  }
  std::mt19937_64 generator(seed);
  const auto start = std::chrono::steady_clock::now();
  const auto is_over = [&](const long run)
  {
    if (seconds > 0.)
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds;
    return run >= n_runs;
  };
  long run = 0, n_faults = 0;
  for (; !is_over(run); ++run)
  {
    std::vector<std::uint8_t> data(96);
    for (std::uint8_t &byte : data)
      byte = static_cast<std::uint8_t>(generator());
    if (const char *what = fault(pair_from(Bytes(data))))
    {
      std::printf("run %ld, %s: --input %s\n", run, what, hex(data).c_str());
      ++n_faults;
      if (!goes_on)
        return 1;
    }
  }
  std::printf("%ld pairs, %ld faults, %ld without proof\n", run, n_faults, n_unproven);
  return n_faults > 0;
}
#endif
