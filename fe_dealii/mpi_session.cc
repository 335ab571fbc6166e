#include "fe_dealii/mpi_session.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

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
  mpi = std::make_unique<Mpi>(argc, argv);
}

MpiSession::~MpiSession() = default;

} // namespace bergamo::fe
