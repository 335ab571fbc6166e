#pragma once

#include "fe_dealii/element/small_strain_hexahedra.h"

namespace bergamo::fe
{

/// The same hexahedra at large strain and rotation: laws of small strain in rate form. An increment counts in the
/// middle of its step (Hughes & Winget, Int. J. Numer. Methods Eng. 15 (1980) 1862-1867): its strain is that of the
/// present shape, with the dilatation at its mean over the present volume, and the stress is turned by its spin, so a
/// rigid rotation is none of the law's matter. Forces are those of the present shape, too.
///
/// The stresses that the law carries are Kirchhoff's, J σ: their work by the rate of strain counts with the reference
/// volume, and an isotropic law stores and dissipates the same energies as at small strain, so the account of a body
/// closes as it does there. Strength and stiffness are those of J σ, which differs from σ by the volume strain.
///
/// Stresses at the start that are uneven in an element keep their constant force, see SmallStrainHexahedra.
template <class Law>
class LargeStrainHexahedra final : public SmallStrainHexahedra<Law>
{
public:
  using SmallStrainHexahedra<Law>::SmallStrainHexahedra;

  std::optional<std::size_t> compute_forces(std::size_t begin, std::size_t end, const double *displacement,
                                            const double *before) override;
  void stiffness(std::size_t element, const double *displacement, double *matrix) const override;
  bool stiffens_with_displacement() const override { return true; }
  void tangent(std::size_t element, const double *displacement, const double *before, double *matrix) const override;
  bool has_symmetric_tangent() const override { return false; }
  ElementState state_of(std::size_t element, const double *displacement) const override;

private:
  using History = typename SmallStrainElements<Law>::History;
  using Report = typename SmallStrainElements<Law>::Report;

  /// Carries an element from one displacement of its nodes to another [m]. @param force of the latter [N]
  /// @return whether it could follow
  bool carry(std::size_t element, const double *now, const double *before, History &history, Report *report,
             double *force) const;
};

extern template class LargeStrainHexahedra<LinearElastic>;
extern template class LargeStrainHexahedra<MohrCoulomb>;
extern template class LargeStrainHexahedra<HypoplasticSand>;

} // namespace bergamo::fe
