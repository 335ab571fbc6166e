#pragma once

#include "fe_dealii/explicit_body.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>

namespace bergamo::fe
{

/// Of elements of 8 nodes: assembled M^(-1/2) K M^(-1/2), dense.
inline dealii::LAPACKFullMatrix<double> dynamic_matrix(const ExplicitBody &body)
{
  const unsigned int n = 3 * body.n_nodes();
  dealii::LAPACKFullMatrix<double> matrix(n);
  for (std::size_t e = 0; e < body.n_elements(); ++e)
  {
    double k[24][24];
    body.elements().stiffness(e, body.displacement().data(), &k[0][0]);
    const auto nodes = body.element_nodes(e);
    for (unsigned int i = 0; i < 24; ++i)
      for (unsigned int j = 0; j < 24; ++j)
      {
        const unsigned int r = 3 * nodes[i / 3] + i % 3, c = 3 * nodes[j / 3] + j % 3;
        matrix(r, c) += k[i][j] / std::sqrt(body.mass()[r] * body.mass()[c]);
      }
  }
  return matrix;
}

inline double true_largest_eigenvalue(const ExplicitBody &body)
{
  auto matrix = dynamic_matrix(body);
  matrix.compute_eigenvalues();
  double largest = 0;
  for (unsigned int i = 0; i < matrix.m(); ++i)
    largest = std::max(largest, matrix.eigenvalue(i).real());
  return largest;
}

} // namespace bergamo::fe
