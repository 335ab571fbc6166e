#pragma once

#include "dem/force/contacts.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/// Contacts made by hand for the tests of what is measured from them.
namespace measured
{

using namespace bergamo;
using namespace bergamo::dem;

/// Normal along the branch. @param tangential on body 1 [N]
inline TouchingContact contact(const std::int32_t first, const std::int32_t second, const Vec3 &branch,
                               const double normal_force, const Vec3 &tangential = Vec3::Zero())
{
  TouchingContact c{};
  c.first = first;
  c.second = second;
  c.branch = branch;
  c.state.normal = branch.normalized();
  c.state.forces = {tangential, normal_force};
  c.state.weight = 1.;
  return c;
}

inline TouchingContact contact(const std::int32_t first, const std::int32_t second)
{
  return contact(first, second, Vec3::UnitX(), 1.);
}

inline Particles unit_spheres(const std::size_t n)
{
  Particles particles;
  for (std::size_t i = 0; i < n; ++i)
    particles.add({Vec3::Ones(), 1., 1.}, 1., Vec3::Zero(), Quaternion::Identity());
  return particles;
}

/// Touching spheres on a periodic lattice, every contact with the same normal force.
struct Lattice
{
  std::vector<Vec3> centres; ///< in a cubic cell about the origin's corner
  double edge;               ///< of the cell
  double spacing;            ///< of neighbours
  std::vector<TouchingContact> contacts;

  /// @param basis places in the unit cube; @param n unit cubes along an edge, 3 or more; @param distance of neighbours
  Lattice(const std::vector<Vec3> &basis, const int n, const double distance, const double normal_force)
      : edge(n), spacing(distance)
  {
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z)
          for (const Vec3 &b : basis)
            centres.push_back(Vec3(x, y, z) + b);
    for (std::size_t i = 0; i < centres.size(); ++i)
      for (std::size_t j = i + 1; j < centres.size(); ++j)
      {
        Vec3 branch = centres[j] - centres[i];
        for (int d = 0; d < 3; ++d)
          branch[d] -= edge * std::round(branch[d] / edge);
        if (branch.norm() < distance * 1.001)
          contacts.push_back(contact(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), branch, normal_force));
      }
  }

  double volume() const { return edge * edge * edge; }
};

inline Lattice simple_cubic(const int n, const double normal_force)
{
  return Lattice({Vec3::Zero()}, n, 1., normal_force);
}

inline Lattice face_centred_cubic(const int n, const double normal_force)
{
  return Lattice({Vec3::Zero(), {0.5, 0.5, 0.}, {0.5, 0., 0.5}, {0., 0.5, 0.5}}, n, std::sqrt(0.5), normal_force);
}

/// Contacts between n grains with random branches, forces and weights; tangential forces up to the limit for friction.
inline std::vector<TouchingContact> random_contacts(const std::int32_t n_grains, const int n, const double friction)
{
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0., 1.);
  std::uniform_int_distribution<std::int32_t> grain(0, n_grains - 1), step(1, n_grains - 1);
  const auto vector = [&] { return Vec3(normal(generator), normal(generator), normal(generator)); };
  std::vector<TouchingContact> contacts;
  for (int k = 0; k < n; ++k)
  {
    const std::int32_t first = grain(generator), second = (first + step(generator)) % n_grains;
    TouchingContact c = contact(first, second, vector(), share(generator));
    const Vec3 along = c.state.normal.cross(vector()).normalized();
    c.state.forces.tangential = std::min(1., 1.2 * share(generator)) * friction * c.state.forces.normal * along;
    c.state.weight = share(generator);
    contacts.push_back(c);
  }
  return contacts;
}

/// The same contacts with bodies 1 and 2 exchanged.
inline std::vector<TouchingContact> exchanged(std::vector<TouchingContact> contacts)
{
  for (TouchingContact &c : contacts)
  {
    std::swap(c.first, c.second);
    c.state.normal *= -1.;
    c.state.forces.tangential *= -1.;
    c.branch *= -1.;
  }
  return contacts;
}

inline std::vector<TouchingContact> rotated(std::vector<TouchingContact> contacts, const Quaternion &q)
{
  for (TouchingContact &c : contacts)
  {
    c.state.normal = q * c.state.normal;
    c.state.forces.tangential = q * c.state.forces.tangential;
    c.branch = q * c.branch;
  }
  return contacts;
}

} // namespace measured
