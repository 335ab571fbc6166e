#include "dem/packing/gap_search.h"

#include "dem/geometry/pair_search.h"

#include <algorithm>

namespace bergamo::dem
{
void search_gaps(const std::span<GrainGap *const> pairs, const std::span<const BodyPose> poses,
                 const std::span<const Vec3> centre_lines)
{
  for (std::size_t from = 0; from < pairs.size(); from += pack_width)
  {
    const int n = static_cast<int>(std::min<std::size_t>(pack_width, pairs.size() - from));
    const auto at = [&](const int lane) { return from + (lane < n ? lane : 0); };
    Pose<Pack> body1 = gather_poses([&](const int k) -> const BodyPose & { return poses[pairs[at(k)]->first]; }),
               body2 = gather_poses([&](const int k) -> const BodyPose & { return poses[pairs[at(k)]->second]; });
    Vector3<Pack> guess;
    for (int d = 0; d < 3; ++d)
    {
      body1.position[d] = Pack(0.);
      body2.position[d] = math::generate<Pack>([&](const int k) { return centre_lines[at(k)][d]; });
      guess[d] = math::generate<Pack>([&](const int k) { return pairs[at(k)]->normal[d]; });
    }
    const FoundContacts<Pack> found = search_pairs<Pack>(body1, body2, guess, n);
    for (int k = 0; k < n; ++k)
    {
      GrainGap &pair = *pairs[from + k];
      pair.normal = math::lane<Pack>(found.normal, k);
      pair.width = -math::lane(found.overlap, k);
      pair.height1 = pair.normal.dot(math::lane<Pack>(found.arm1, k));
      pair.height2 = -pair.normal.dot(math::lane<Pack>(found.arm2, k));
    }
  }
}

} // namespace bergamo::dem
