# Headers that are read once for all sources of a kind. A source compiles in a third of the time; none depends on it,
# since every file still includes what it uses.
set(BERGAMO_CORE_HEADERS <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <iostream> <limits>
  <map> <memory> <optional> <random> <span> <sstream> <string> <unordered_map> <variant> <vector>
  <Eigen/Dense> <Eigen/SparseCore> ${PROJECT_SOURCE_DIR}/dem/core/pack_vectors.h)
set(BERGAMO_FE_HEADERS ${BERGAMO_CORE_HEADERS} <deal.II/base/quadrature_lib.h> <deal.II/dofs/dof_handler.h>
  <deal.II/fe/fe_q.h> <deal.II/fe/fe_values.h> <deal.II/grid/tria.h> <deal.II/lac/vector.h>)

# bergamo_dealii_sources(<variable> SOURCES...): those that name deal.II.
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

# bergamo_library(<name> SOURCES...): a static library from precompiled headers. What names deal.II is compiled apart, since
# every other source would wait one second more for its 700 MB of them.
function(bergamo_library name)
  bergamo_dealii_sources(dealii_sources ${ARGN})
  list(REMOVE_ITEM ARGN ${dealii_sources})
  add_library(${name} STATIC ${ARGN})
  target_precompile_headers(${name} REUSE_FROM bergamo_core)
  if(NOT dealii_sources)
    return()
  endif()
  add_library(${name}_dealii OBJECT ${dealii_sources})
  target_link_libraries(${name}_dealii PRIVATE $<TARGET_PROPERTY:${name},LINK_LIBRARIES>)
  target_sources(${name} PRIVATE $<TARGET_OBJECTS:${name}_dealii>)
  if(name STREQUAL bergamo_fe)
    target_precompile_headers(${name}_dealii PRIVATE ${BERGAMO_FE_HEADERS})
  else()
    target_precompile_headers(${name}_dealii REUSE_FROM bergamo_fe_dealii)
  endif()
endfunction()
