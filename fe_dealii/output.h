#pragma once

#include <filesystem>

namespace bergamo::fe
{

class ExplicitBody;
class MembraneBody;

/// Writes the body as a VTU file for ParaView, elements of 27 nodes as quadratic cells (5.5 and later): displacement
/// and velocity at the nodes; stress_xx .. stress_zx, principal_stress_1 >= 2 >= 3, pressure p = −tr/3,
/// deviatoric_stress q = sqrt(3 J2), yield_function [Pa], equivalent_plastic_strain [-] and elastic_energy_density
/// [J/m³] as volume averages of the cells, and the void_ratio [-] of a law that has one. The mesh is in the reference
/// configuration. Written aside and then renamed: the file appears whole or not at all. Throws RunError if it cannot be
/// written.
void write_vtu(const ExplicitBody &body, const std::filesystem::path &path);

/// The same for membranes: displacement and velocity; of the cells principal_stress_1 >= 2 of Cauchy's stress in the
/// plane [Pa], thickness [m] and elastic_energy_density [J/m³].
void write_vtu(const MembraneBody &body, const std::filesystem::path &path);

} // namespace bergamo::fe
