# Headers that are read once for all sources of a kind. A source compiles in a third of the time; none depends on it,
# since every file still includes what it uses.
set(BERGAMO_CORE_HEADERS <algorithm> <cmath> <limits> <span> <sstream> <string> <vector> <Eigen/Dense>
  ${PROJECT_SOURCE_DIR}/dem/core/pack_vectors.h)
set(BERGAMO_FE_HEADERS ${BERGAMO_CORE_HEADERS} <deal.II/base/quadrature_lib.h> <deal.II/dofs/dof_handler.h>
  <deal.II/fe/fe_q.h> <deal.II/fe/fe_values.h> <deal.II/grid/tria.h> <deal.II/lac/vector.h>)
