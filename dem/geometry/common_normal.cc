#include "dem/geometry/common_normal.h"

#include "dem/geometry/centre_line.h"
#include "dem/geometry/least_minimum.h"
#include "dem/geometry/newton_search.h"
#include "dem/geometry/search_result.h"

namespace bergamo::dem
{
namespace
{
constexpr int max_evaluations = 250;
}

ContactGeometry find_contact(const BodyPose &body1, const BodyPose &body2)
{
  NewtonSearch<double> search(body1, body2, centre_direction<double>(body2.position - body1.position));
  search.run(max_evaluations);
  const ContactGeometry result = result_of(search, 0);
  return result.status == ContactStatus::undecided || is_suspicious(search) ? find_least_minimum(body1, body2, result)
                                                                            : result;
}

ContactGeometry update_contact(const BodyPose &body1, const BodyPose &body2, const Vec3 &guess)
{
  NewtonSearch<double> search(body1, body2, guess);
  search.run(max_evaluations);
  const ContactGeometry result = result_of(search, 0);
  if (result.status == ContactStatus::undecided || is_saddle(search))
    return find_contact(body1, body2);
  return result;
}

} // namespace bergamo::dem
