#include "dem/geometry/pair_search.h"
#include "tests/unit/dem_contact_pairs.h"
#include "tests/unit/dem_contact_reference.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <utility>
#include <vector>

using namespace bergamo;
using namespace bergamo::dem;
using namespace contact_pairs;

namespace
{

using GrainPair = std::pair<Grain, Grain>;

Grain grain(const Vec3 &half_axes, const double eps1, const double eps2, const Vec3 &position,
            const std::array<double, 4> &wxyz)
{
  return {{half_axes, eps1, eps2}, position, Quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized()};
}

/// That nothing lower exists is proven by the reference, for each order of the bodies and in packs.
void check_least(const GrainPair &pair, const ContactStatus expected)
{
  const auto &[grain1, grain2] = pair;
  const BodyPose a = grain1.pose(), b = grain2.pose();
  const double smallest = std::min(grain1.shape.half_axes.minCoeff(), grain2.shape.half_axes.minCoeff());
  const double tolerance = 1e-9 * smallest;
  const ContactGeometry found = find_contact(a, b), exchanged = find_contact(b, a);
  CHECK(found.status == expected);
  CHECK(exchanged.status == expected);
  CHECK(std::abs(phi(a, b, found.normal) - found.overlap) < 1e-13);
  if (expected != ContactStatus::touching)
    return;
  const contact_reference::Judgement judgement = contact_reference::judge(a, b, found.overlap - tolerance);
  CAPTURE(judgement.phi / smallest, found.overlap / smallest);
  CHECK(judgement.verdict == contact_reference::Verdict::nothing_lower);
  CHECK(std::abs(exchanged.overlap - found.overlap) < tolerance);
  const Pack zero(0.);
  const FoundContacts<Pack> packed =
      search_pairs<Pack>(in_every_lane(a), in_every_lane(b), {zero, zero, zero}, pack_width);
  for (int lane = 0; lane < pack_width; ++lane)
  {
    CHECK_FALSE(packed.is_undecided[lane]);
    CHECK(std::abs(math::lane(packed.overlap, lane) - found.overlap) < tolerance);
  }
  const ContactGeometry again = update_contact(a, b, found.normal);
  CHECK(again.status == ContactStatus::touching);
  CHECK(std::abs(again.overlap - found.overlap) < tolerance);
}

} // namespace

TEST_CASE("pointed grains: the lower of two minima, on the other side of a ridge")
{
  // A pointed body is flat up to the ridge: in three of these pairs the radius of curvature at the higher minimum is
  // 300 to 4500 overlaps, in the third there are many minima within a tenth.
  const std::vector<GrainPair> pairs{
      {grain({0.0888493402937, 0.332760518076, 0.803243519144}, 0.0327406729229, 1.84987167163, {0, 0, 0},
             {0.158978867794, 0.987281985856, 0, 0}),
       grain({0.0888493402937, 0.332760518076, 0.803243519144}, 0.0327406729229, 1.84987167163,
             {-1.0054026559e-06, 0.25215391992, 1.56587893648}, {1, 0, 0, 0})},
      {grain({0.676583108351, 0.0785546178408, 0.26970559361}, 1.73353078508, 0.625869840543, {0, 0, 0},
             {1, 0, -0, -0}),
       grain({0.0899527340007, 0.05, 0.650887797755}, 0.0614819562066, 1.64937056535,
             {0.618246110453, -7.11358221716e-07, -0.825685851543},
             {1, 1.59704439307e-07, -5.32747698042e-08, 4.42358146968e-07})},
      {grain({0.137331005678, 0.509258403331, 0.210710777518}, 1.98, 1.0330031281, {0, 0, 0},
             {0.998341747626, -0.0314434344791, -0.0138979685921, -0.0461726308951}),
       grain({0.759257372577, 0.0941643830576, 0.0679329773795}, 1.9761419089, 1.9761419089,
             {-0.792820667948, -0.401320592811, -0.105800406497},
             {0.999999667937, 9.58237944265e-05, -0.0007745383295, 0.000234594950322})}};
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    CAPTURE(i);
    check_least(pairs[i], ContactStatus::touching);
  }
}

TEST_CASE("symmetric pairs: the middle of a flat face may be the higher of two minima")
{
  // The centre line is a common normal in both pairs, and the curvature of a flat face is infinite in its very middle.
  const std::vector<GrainPair> pairs{{grain({0.0621282286369, 0.474749701892, 0.069889030794}, 1.61751888304,
                                            0.767213550011, {0, 0, 0}, {0.999296537567, 0, 0.0375024000108, 0}),
                                      grain({0.0621282286369, 0.474749701892, 0.069889030794}, 1.61751888304,
                                            0.767213550011, {0, -0.948598781602, 0}, {1, 0, 0, 0})},
                                     {grain({0.794951668368, 0.250305798635, 0.0555812634758}, 0.262222323949,
                                            1.46540840772, {0, 0, 0}, {0.688332842429, 0, 0.725394994492, 0}),
                                      grain({0.301708816827, 0.627142296413, 0.101411529176}, 1.49549553674,
                                            0.814437781338, {0, 0.876594634293, 0}, {1, 0, 0, 0})}};
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    CAPTURE(i);
    check_least(pairs[i], ContactStatus::touching);
  }
}

TEST_CASE("tips of boxes: a face that is flat up to its edge may hold the higher of two minima")
{
  // The normal is 7e-4 off the middle of a face that is flat until that is one: the other face is 17 % shallower.
  const Vec3 half_axes(0.01097387762643633, 0.0028307136131567397, 0.47155594723541444);
  check_least({grain(half_axes, 0.044709889448386365, 1.2094603841153582, {0, 0, 0}, {1, 0, 0, 0}),
               grain(half_axes, 0.044709889448386365, 1.2094603841153582,
                     {7.6533664833378028e-05, 1.7112282439589764e-05, 0.94305461999771401},
                     {1, 1.016565e-07, -4.3331261e-07, 1.209665e-06})},
              ContactStatus::touching);
  // The end of a flat prism, 5e-4 off its middle: a corner of it is half as deep.
  const Vec3 prism(0.00018914665146038033, 0.026270631460646999, 0.10649118241110987);
  check_least({grain(prism, 0.83277654625772501, 1e-6, {0, 0, 0}, {1, -3.6067247e-07, 5.1175937e-07, -6.9269295e-07}),
               grain(prism, 0.83277654625772501, 1e-6,
                     {-7.7976657299093911e-06, 0.052539053026633725, 0.21298189297447387}, {1, 0, 0, 0})},
              ContactStatus::touching);
}

TEST_CASE("crossed edges that seem to touch while another direction separates the grains")
{
  // phi is least at the kink of both edges nearby, and negative ten degrees on.
  check_least({grain({0.830917473819, 0.0892115479631, 0.426999021988}, 0.183266041047, 1.652421149, {0, 0, 0},
                     {0.127311463585, 0.991862788515, 0, 0}),
               grain({0.0591895965241, 0.463174221578, 0.0557797939535}, 0.02, 0.02, {0, -0, 0.493121085328},
                     {0.895088492013, 0, 0.445888541529, 0})},
              ContactStatus::separated);
}

TEST_CASE("a face on a ridge, turned by a millionth, is decided")
{
  // phi has a kink there, where Newton's method does not come to rest.
  check_least(
      {grain({0.156755062958, 0.103391518968, 0.47215262362}, 1.45434256504, 0.02, {0, 0, 0},
             {0.406013928032, 0.91386688869, 0, 0}),
       grain({0.50379404188, 0.315358955623, 0.392535128757}, 0.62563057908, 0.411102769512, {0, 0, 0.64108705995},
             {0.999999999999, -5.75575323966e-07, 5.76218853983e-07, 6.50723022837e-07})},
      ContactStatus::touching);
}
