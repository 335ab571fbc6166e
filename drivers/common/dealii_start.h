#pragma once

namespace bergamo::driver
{

/// deal.II of a program: it has one thread of its own, and its mistakes are exceptions. Called once, before meshes.
void start_dealii();

} // namespace bergamo::driver
