#include "fe_dealii/mpi_session.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cstdlib>

namespace bergamo::fe
{

struct MpiSession::Mpi
{
  Mpi(int &argc, char **&argv) : started(argc, argv, 1) {}

  dealii::Utilities::MPI::MPI_InitFinalize started;
};

MpiSession::MpiSession(int &argc, char **&argv)
{
  dealii::deal_II_exceptions::disable_abort_on_exception();
  // One process shares nothing with others. Open MPI's folder for that would stay where a signal ends the program.
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", /*overwrite=*/0);
  mpi = std::make_unique<Mpi>(argc, argv);
}

MpiSession::~MpiSession() = default;

} // namespace bergamo::fe
