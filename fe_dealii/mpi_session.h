#pragma once

#include <memory>

namespace bergamo::fe
{

/// MPI and deal.II of a program, for as long as it lives: deal.II has one thread of its own, and its mistakes are
/// exceptions. One a program, made before anything that needs MPI (equilibrium/). Leaves no files, however the program
/// ends.
class MpiSession
{
public:
  MpiSession(int &argc, char **&argv);
  ~MpiSession();

private:
  struct Mpi;
  std::unique_ptr<Mpi> mpi;
};

} // namespace bergamo::fe
