#pragma once

namespace bergamo::driver
{

/// Throws ConfigError with the remedy where MPI would not start, which it tells in pages of its own and then ends the
/// program: where it may not open its files.
void require_mpi_can_start();

} // namespace bergamo::driver
