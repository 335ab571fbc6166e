#pragma once

#include "fe_dealii/explicit_body.h"
#include "fe_dealii/material/tensor.h"

namespace bergamo::fe
{

/// Gives a body the displacement x = F X.
inline void deform(ExplicitBody &body, const Tensor3<double> &f)
{
  for (std::size_t node = 0; node < body.n_nodes(); ++node)
    for (int i = 0; i < 3; ++i)
    {
      double &u = body.displacement()[3 * node + i];
      u = -body.node_position()[node][i];
      for (int j = 0; j < 3; ++j)
        u += f[i][j] * body.node_position()[node][j];
    }
}

} // namespace bergamo::fe
