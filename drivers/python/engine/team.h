#pragma once

namespace bergamo::python
{

/// Threads that compute, for whichever thread of Python asks for it; 0: as OpenMP is set.
void set_team(int n_threads);

/// As many as the next call will have.
int team();

/// Gives the calling thread the team: OpenMP keeps such a number for each thread apart.
void take_team();

} // namespace bergamo::python
