#pragma once

#include "dem/force/touching_contact.h"
#include "dem/measure/tensor.h"

#include <span>

namespace bergamo::dem
{

/// Fabric tensor of the contact normals, mean of n (x) n (Satake 1982): of trace one, a third of the identity where
/// they have no preferred direction, zero without contacts. Global frame.
Mat3 fabric_tensor(std::span<const TouchingContact> contacts);

/// Anisotropy a = 15/2 sqrt(3/2 F':F') of the contact normals (Kanatani 1984): where their density over the unit sphere
/// is (1 + A:n (x) n) / 4 pi with A symmetric about an axis, 4 pi times the density along the axis differs by a from
/// the one across.
inline double fabric_anisotropy(const Mat3 &fabric)
{
  return 7.5 * equivalent(fabric);
}

} // namespace bergamo::dem
