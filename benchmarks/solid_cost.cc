#include "benchmarks/solid_cost.h"

#include "fe_dealii/element/bending_hexahedron.h"
#include "fe_dealii/element/hexahedron.h"
#include "fe_dealii/element/solid_geometry.h"
#include "fe_dealii/element/stress_update.h"

namespace bergamo::benchmark
{
namespace
{

constexpr double logarithm = 20., exponential = 20., power = logarithm + 1. + exponential;

/// Cyclic Jacobi: a rotation 41 (14 for the angle, 4 on the diagonal, 5 beside it, 18 for the vectors), three and the
/// criterion 11 make a sweep, four sweeps and three exchanges a frame.
constexpr double principal_frame = 4. * (3. * 41. + 11.) + 3.;

/// The dyads of a stress: 22 to scale its deviator, 14 for the determinant, 32 for the value apart (16 of them its
/// polynomial), 27 for its dyad, 16 for the plane across, 21 to scale that, 19 for roots, signs and values. Then 33 for
/// the return by masks, 26 back to components, 68 for both measures of the plastic strain and their books.
constexpr double principal_dyads = 22. + 14. + 32. + 27. + 16. + 21. + 19.;

struct StressOfPoint
{
  double flowing_share;

  /// 12 for the elastic stress and 6 to add it.
  double operator()(const fe::LinearElastic &) const { return 18.; }

  /// 18 for the trial stress, 18 for its invariants, 6 to see that it lies inside; if not, dyads, return and measures.
  /// Stiffness by pressure: 4 for the pressure, its power, 6 to scale, 26 for the elastic work.
  double operator()(const fe::MohrCoulomb &law) const
  {
    return 42. + flowing_share * (principal_dyads + 33. + 26. + 68.) + (law.depends_on_pressure() ? 36. + power : 0.);
  }

  /// One substep: four times the response with its three powers, and the rate; sums and error of the substep.
  double operator()(const fe::HypoplasticSand &) const { return 4. * (150. + 3. * power + exponential + 40.) + 150.; }

  /// 28 for the stress, 15 + 5 for tr C and the energy.
  double operator()(const fe::NeoHooke &) const { return 48. + logarithm; }

  /// C 30, invariants 16, their derivatives 19, F S 45, the part along F^-T 18, the energy 5.
  double operator()(const fe::MooneyRivlin &) const { return 133. + power; }

  /// C 30, its frame; each stretch: logarithm 2, a term 12 (stress, energy and sums) and an exponential; each direction
  /// 23 for S; F S 45.
  double operator()(const fe::Ogden &law) const
  {
    int n_terms = 0;
    for (const double modulus : law.parameters().modulus)
      n_terms += modulus != 0.;
    return 30. + principal_frame + power + 3. * (2. + logarithm + n_terms * (12. + exponential)) + 3. * 23. + 45.;
  }
};

} // namespace

Operations operations_of(const SolidCase &what, const double nodes_per_element, const double flowing_share)
{
  const double n = what.nodes_per_element();
  const bool small = what.is_of_small_strain(), trilinear = what.degree == 1;
  Operations o;
  o.strain = small ? 3. * n + n * (18. * n + (trilinear ? 9. : 0.)) : n * (18. * n + 35.);
  o.stress = n * std::visit(StressOfPoint{flowing_share}, what.material);
  o.force = n * (18. * n + (small ? (trilinear ? 16. : 6.) : (trilinear ? 27. : 27. + 8. + logarithm)));
  if (what.bends())
  {
    o.strain = (small ? 3. * n : 35. + 216. + 30. * 8.) + 3. * 2. * 7. * n;
    o.stress = std::visit(StressOfPoint{flowing_share}, what.material);
    o.force = 2. * 144. + 3. * 2. * 7. * n + (small ? 6. : 216. + 27. + 28.);
  }
  o.motion = 3. * n + 3. * 35. * nodes_per_element;
  return o;
}

ElementMemory memory_of(const SolidCase &what, const double nodes_per_element, const double flowing_share)
{
  const double n = what.nodes_per_element();
  const int n_packs = fe::packs_of(what.nodes_per_element());
  const bool small = what.is_of_small_strain(), trilinear = what.degree == 1;
  constexpr double line = sizeof(fe::Points), real = sizeof(double), index = sizeof(unsigned int);
  ElementMemory memory;
  const double per_pack = what.bends() ? 1. / fe::points_per_pack : 1.; // of an element in the packs of its points
  memory.geometry = what.bends() ? per_pack * sizeof(fe::bending::Geometry<fe::Points>) + (small ? 0. : 3. * n * real)
                    : trilinear  ? (small ? sizeof(fe::hexahedron::Geometry) : sizeof(fe::SolidGeometry<8, 1>))
                                 : sizeof(fe::SolidGeometry<27, 4>);
  memory.history = small ? per_pack * n_packs * (sizeof(fe::PointHistory) + fe::points_per_pack) : real;
  const double modes = what.bends() && small ? fe::bending::n_amplitudes * real : 0.;
  memory.history += modes;
  memory.force = 3. * n * real;
  // Indices of the nodes and places of their sums; at a node seven vectors, constraints, position, head of its places.
  memory.nodes = 2. * n * index + nodes_per_element * (3. * (7. * real + sizeof(int) + real) + sizeof(std::size_t));

  const auto *const sand = std::get_if<fe::MohrCoulomb>(&what.material);
  // Stresses; plastic strain and dissipation where it flows; elastic work.
  const double lines = 6. + (flowing_share > 0. ? 2. : 0.) + (sand && sand->depends_on_pressure() ? 1. : 0.);
  const double history =
      2. * modes +
      (small ? per_pack * n_packs * (2. * lines * line + (sand ? 2. * fe::points_per_pack : 0.)) : 2. * real);
  // A node's three components of: displacement, and the one before with small strain, to gather; displacement, the one
  // before (written) and the internal force (written) in its sum; velocity, reaction (both written), mass, external and
  // internal force and the constraint in a kick; displacement (written) and velocity in a drift.
  const double vectors = 1. + small + (1. + 2. + 2.) + (2. + 2. + 3.) + (2. + 1.);
  memory.moved = memory.geometry + history + 3. * memory.force + 2. * n * index +
                 nodes_per_element * (3. * (vectors * real + sizeof(int)) + sizeof(std::size_t));
  return memory;
}

} // namespace bergamo::benchmark
