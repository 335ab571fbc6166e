#pragma once

#include "benchmarks/peers/bulk_case.h"

#include <array>
#include <string>

namespace bergamo::benchmark
{

/// A vessel's triangles as STL text, with all digits.
std::string stl_text(const dem::Surface &vessel);

/// Lowest and highest places that a case needs: of its vessel at any turn, and of its beads until they are taken out
/// [m].
std::array<Vec3, 2> reach_of(const BulkCase &bulk);

/// The coefficient of restitution e for which sqrt(5/6) |ln e| / sqrt(pi^2 + ln^2 e) is a damping ratio below 0.9128:
/// what programs ask for that give no bound f >= 0 a thought when they make a dashpot of it (Antypov & Elliott 2011).
double unbounded_restitution(double damping_ratio);

} // namespace bergamo::benchmark
