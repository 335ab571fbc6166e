#pragma once

namespace bergamo::fe
{

/// Void ratios between which a skeleton of grains can be at one pressure [-]. All three fall with it alike:
/// e_d/e_d0 = e_c/e_c0 = e_i/e_i0 = exp(−(3p/h_s)^n) (Bauer, Soils and Foundations 36(1) (1996) 13-26; Gudehus, ibid.
/// 1-12). Where 3p stands here, theirs is −tr T, the same.
struct LimitVoidRatios
{
  double densest;  ///< e_d
  double critical; ///< e_c, of steady flow
  double loosest;  ///< e_i, of isotropic compression from the loosest start
};

} // namespace bergamo::fe
