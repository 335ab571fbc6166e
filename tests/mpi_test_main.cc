// Runs the tests of what Trilinos solves, which needs MPI, on one thread as test_main.cc does.
#define CATCH_CONFIG_RUNNER
#include "fe_dealii/mpi_session.h"

#include <catch2/catch.hpp>

#include <omp.h>

int main(int argc, char **argv)
{
  omp_set_num_threads(1);
  const bergamo::fe::MpiSession mpi(argc, argv);
  return Catch::Session().run(argc, argv);
}
