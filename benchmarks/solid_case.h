#pragma once

#include "fe_dealii/explicit_body.h"

#include <string>
#include <vector>

namespace bergamo::benchmark
{

/// A material in elements of one kind, and how it is deformed while its steps are timed.
struct SolidCase
{
  std::string name;
  unsigned int degree; ///< 1: 8 nodes, 2: 27 nodes
  fe::Material material;
  double initial_pressure = 0.; ///< [Pa]
  double initial_strain = 0.;   ///< greatest principal strain of the start, at large strain
  double strain_per_step = 0.;  ///< most compressive principal strain of one step
  int n_first_steps = 5;        ///< before any time is taken: to flow, and to bring the data to the core
  fe::Hourglass hourglass = fe::Hourglass::at_points; ///< of 8 nodes

  fe::InitialStress initial_stress() const
  {
    return initial_pressure > 0. ? fe::uniform_pressure(initial_pressure) : fe::InitialStress();
  }
  int nodes_per_element() const { return degree == 1 ? 8 : 27; }
  bool bends() const { return hourglass == fe::Hourglass::bending; } ///< the law once an element
  /// Points at which an element asks its law.
  int n_points() const { return bends() ? 1 : nodes_per_element(); }
  bool is_of_small_strain() const
  {
    return std::holds_alternative<fe::LinearElastic>(material) || std::holds_alternative<fe::MohrCoulomb>(material) ||
           std::holds_alternative<fe::HypoplasticSand>(material);
  }
};

/// Elastic and Mohr-Coulomb (elastic, flowing, flowing with a stiffness that grows with the pressure) at small strain,
/// Neo-Hooke, Mooney-Rivlin and Ogden at large strain; all of 8 nodes, then of 8 nodes that bend, then of 27.
std::vector<SolidCase> solid_cases();

/// A cube of bricks that deforms isochorically at a steady rate, along directions oblique to the axes and with a jitter
/// at each node: no stress is diagonal and no two points are alike, which the principal frames would profit from.
struct MovingSolid
{
  /// @param n_along edges of the cube
  MovingSolid(const SolidCase &what, int n_along);

  /// Seconds that each part of a step took, over some steps.
  struct Times
  {
    double force = 0., kick = 0., drift = 0.;
    double whole() const { return force + kick + drift; }
  };
  Times step(int n_steps);

  /// Share of the quadrature points on the yield surface after the last step; 0 for other materials.
  double flowing_share() const;

  fe::ExplicitBody body;
  int n_points;     ///< at which an element asks its law
  double time_step; ///< a fifth of what a wave takes from node to node along an edge [s]
};

/// Edges of a cube of about so many elements of 8 nodes, or of as many nodes in elements of 27.
int edges_of_cube(const SolidCase &what, int n_elements);

} // namespace bergamo::benchmark
