#pragma once

#include "dem/packing/pack_grains.h"

#include <string>

namespace bergamo::driver
{

/// Throws RunError for a packing that got stuck before the solid fraction that was asked for.
/// @param setting that asks for it, as the user writes it
void require_target(const dem::PackedGrains &packed, double solid_fraction, const std::string &setting);

} // namespace bergamo::driver
