// Runs the tests of what Trilinos solves, which needs MPI.
#define CATCH_CONFIG_RUNNER
#include "fe_dealii/mpi_session.h"

#include <catch2/catch.hpp>

int main(int argc, char **argv)
{
  const bergamo::fe::MpiSession mpi(argc, argv);
  return Catch::Session().run(argc, argv);
}
