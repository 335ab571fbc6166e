# Headers that are read once for all sources of a kind. A source compiles in a third of the time; none depends on it,
# since every file still includes what it uses.
set(BERGAMO_CORE_HEADERS <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <iostream> <limits>
  <map> <memory> <optional> <random> <span> <sstream> <string> <unordered_map> <variant> <vector> <Eigen/Dense>
  ${PROJECT_SOURCE_DIR}/dem/core/pack_vectors.h)
set(BERGAMO_FE_HEADERS ${BERGAMO_CORE_HEADERS} <deal.II/base/quadrature_lib.h> <deal.II/dofs/dof_handler.h>
  <deal.II/fe/fe_q.h> <deal.II/fe/fe_values.h> <deal.II/grid/tria.h> <deal.II/lac/vector.h>)

# bergamo_dealii_sources(<variable> SOURCES...): those that name deal.II. They are compiled apart, because all others would
# wait two seconds each for its 700 MB of precompiled headers.
function(bergamo_dealii_sources variable)
  set(found)
  foreach(source IN LISTS ARGN)
    file(STRINGS ${source} lines REGEX "#include <deal\\.II/" LIMIT_COUNT 1)
    if(lines)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(${variable} ${found} PARENT_SCOPE)
endfunction()
