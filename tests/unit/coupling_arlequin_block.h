#pragma once

#include "coupling/arlequin/overlap.h"

#include <Eigen/LU>

#include <array>
#include <random>

namespace bergamo::coupling::test
{

/// Block of n x n x n trilinear elements (parallelepipeds, so that places in them are known in closed form), filled
/// with particles at random. The mesh counts its nodes backwards and with gaps, to tell both numberings apart.
inline Overlap block(const int n, const int particles_per_element, const unsigned seed = 1)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0., 1.);
  Eigen::Matrix3d edges; // of one element [m]
  edges << 0.010, 0.002, 0.001, 0., 0.012, -0.001, 0.001, 0., 0.009;
  const Eigen::Vector3d origin(0.3, -0.2, 0.1);
  const double element_volume = edges.determinant();

  Overlap overlap;
  const int m = n + 1;
  const auto node = [m](const int i, const int j, const int k) { return (i * m + j) * m + k; };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int k = 0; k < m; ++k)
      {
        overlap.nodes.push_back(2 * (m * m * m - static_cast<int>(overlap.nodes.size())) + 3);
        overlap.node_position.push_back(origin + edges * Eigen::Vector3d(i, j, k));
      }

  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k)
      {
        std::array<int, 8> corner;
        for (int c = 0; c < 8; ++c)
          corner[c] = node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        for (int p = 0; p < particles_per_element; ++p)
        {
          const Eigen::Vector3d place(uniform(random), uniform(random), uniform(random));
          overlap.particle_id.push_back(1000 + 7 * static_cast<std::int64_t>(overlap.particle_id.size()));
          overlap.particle_volume.push_back(element_volume * 0.6 / particles_per_element * (0.5 + uniform(random)));
          overlap.reference_position.push_back(origin + edges * (Eigen::Vector3d(i, j, k) + place));
          for (int c = 0; c < 8; ++c)
          {
            double value = 1.;
            Eigen::Vector3d local = Eigen::Vector3d::Ones(); // gradient over the place in the element
            for (int axis = 0; axis < 3; ++axis)
            {
              const bool is_far = c >> axis & 1;
              const double factor = is_far ? place[axis] : 1. - place[axis];
              value *= factor;
              for (int other = 0; other < 3; ++other)
                local[other] *= other == axis ? (is_far ? 1. : -1.) : factor;
            }
            overlap.shape_node.push_back(corner[c]);
            overlap.shape_value.push_back(value);
            overlap.shape_gradient.push_back(edges.inverse().transpose() * local);
          }
          overlap.shape_offset.push_back(overlap.shape_node.size());
        }
      }
  return overlap;
}

/// The same particles in elements whose nodes are moved at random by a sixth of an edge, so that no two edges of an
/// element are parallel.
inline Overlap distorted(Overlap overlap, const unsigned seed = 3)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-0.0016, 0.0016);
  for (Eigen::Vector3d &x : overlap.node_position)
    x += Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  for (std::size_t particle = 0; particle < overlap.n_particles(); ++particle)
  {
    const std::size_t first = overlap.shape_offset[particle];
    Eigen::Vector3d &place = overlap.reference_position[particle];
    place.setZero();
    Eigen::Matrix3d deformation = Eigen::Matrix3d::Zero(); // of the element, by the gradients that it had
    for (std::size_t k = first; k < first + 8; ++k)
    {
      const Eigen::Vector3d &x = overlap.node_position[overlap.shape_node[k]];
      place += overlap.shape_value[k] * x;
      deformation += x * overlap.shape_gradient[k].transpose();
    }
    for (std::size_t k = first; k < first + 8; ++k)
      overlap.shape_gradient[k] = deformation.inverse().transpose() * overlap.shape_gradient[k];
  }
  return overlap;
}

/// Length of the mesh's vectors of degrees of freedom.
inline std::size_t n_dofs(const Overlap &overlap)
{
  return 3 * (2 * overlap.n_nodes() + 10);
}

} // namespace bergamo::coupling::test
