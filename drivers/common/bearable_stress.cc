#include "drivers/common/bearable_stress.h"

#include <variant>

namespace bergamo::driver
{

Vec3 bearable(const fe::Material &material, const Vec3 &stress)
{
  const auto *law = std::get_if<fe::MohrCoulomb>(&material);
  const Vec3 mean = Vec3::Constant(stress.mean());
  const auto with = [&](const double share) -> Vec3 { return mean + share * (stress - mean); };
  const auto is_borne = [&](const double share)
  {
    const Vec3 s = with(share);
    return !law || law->yield_function({s[0], s[1], s[2], 0., 0., 0.}) <= 0.;
  };
  if (is_borne(1.))
    return stress;
  double borne = 0., too_much = 1.;
  for (int halving = 0; halving < 30; ++halving)
  {
    const double middle = 0.5 * (borne + too_much);
    (is_borne(middle) ? borne : too_much) = middle;
  }
  return with(borne);
}

} // namespace bergamo::driver
