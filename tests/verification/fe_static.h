#pragma once

#include "fe_dealii/equilibrium/static_equilibrium.h"
#include "fe_dealii/explicit_body.h"

#include <algorithm>
#include <map>
#include <span>

/// Brings an elastic body to rest. @param load nodal forces [N]; @param prescribed displacements by dof,
/// 3 node + component, which stay held [m]; @param tolerance some roundings of a slender body
inline void bring_to_rest(bergamo::fe::ExplicitBody &body, const std::span<const double> load,
                          const std::map<unsigned int, double> &prescribed, const double tolerance = 1e-11)
{
  for (const auto &[dof, displacement] : prescribed)
  {
    const unsigned int node[] = {dof / 3};
    body.prescribe_velocity(node, dof % 3, displacement); // over one second
  }
  std::copy(load.begin(), load.end(), body.external_force().begin());
  bergamo::fe::find_equilibrium(body, {.tolerance = tolerance, .duration = 1});
  body.clear_external_force();
}
