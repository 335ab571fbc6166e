// Runs tests beside one another, one a core: a team of threads on cores that are taken costs up to four times as much
// as one thread. What compares numbers of threads sets them.
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <omp.h>

int main(int argc, char **argv)
{
  omp_set_num_threads(1);
  return Catch::Session().run(argc, argv);
}
