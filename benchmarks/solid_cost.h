#pragma once

#include "benchmarks/solid_case.h"

namespace bergamo::benchmark
{

/// Floating-point operations that an element and its nodes need in one step, counted by hand from the formulas: sums,
/// products, quotients, roots and comparisons one each, logarithms and exponentials 20, powers 41 (a logarithm, a
/// product, an exponential). What the code computes beyond, such as empty lanes or something twice, does not count.
struct Operations
{
  double strain = 0., stress = 0., force = 0., motion = 0.;
  double whole() const { return strain + stress + force + motion; }
};

/// With n nodes, as many points and N nodes of the body for each element:
///   strain  small: 3 n increments; a point 18 n (6 products-and-sums for the normal, 12 for the shear strains), with 8
///           nodes 9 more for the mean dilatation.
///           large: a point 18 n for F, 27 for its cofactor, 5 for its determinant, 3 for the volumes.
///   stress  a point, see stress_of_point().
///   force   a point 18 n (15 for the products with the gradients, 3 to sum the points) and, small, 6 weights or with 8
///           nodes 16 with the mean stress; large, 27 for P and its weight, with 27 nodes 28 more for U(J).
///   Elements that bend: 3 n increments of small strain, 2 (3 + 4) n products-and-sums for each of three components of
///   the
///           mean gradient and the four modes; a point, one stress; the modes' forces 2 144; nodal forces as the
///           motion. At large strain F̄ and its cofactor 35, the modes drawn back and forth 216, P and its weight 27,
///           U(J) 28, and at eight points the Jacobian determinant, 30 each and 216 for their edges.
///   motion  3 n sums at the nodes; 33 in a kick (23 of them for the energies) and 2 in a drift for each of 3 N dofs.
/// @param flowing_share of the points on the yield surface
Operations operations_of(const SolidCase &what, double nodes_per_element, double flowing_share);

/// Memory of an element, with its share of the nodes [byte].
struct ElementMemory
{
  double geometry = 0., history = 0., force = 0., nodes = 0.;
  double whole() const { return geometry + history + force + nodes; }

  /// What a step moves between memory and core at least if no element stays in the cache from step to step: a read
  /// once, a write twice for the line is fetched before.
  double moved = 0.;
};
ElementMemory memory_of(const SolidCase &what, double nodes_per_element, double flowing_share);

} // namespace bergamo::benchmark
