#pragma once

namespace bergamo::benchmark
{

/// Resident memory of this process now [byte].
double resident_memory();

} // namespace bergamo::benchmark
