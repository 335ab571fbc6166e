# The libraries that whoever links the grains needs: read by the build, and by the configuration of an installation.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(ZLIB REQUIRED)

# bergamo_external(<name> INCLUDE ... LINK ...): another project's library as a target. Imported, so that exported targets
# name it and whoever uses them finds it on his own machine.
function(bergamo_external name)
  cmake_parse_arguments(arg "" "" "INCLUDE;LINK" ${ARGN})
  if(NOT TARGET ${name})
    add_library(${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${name} SYSTEM INTERFACE ${arg_INCLUDE})
    target_link_libraries(${name} INTERFACE ${arg_LINK})
  endif()
endfunction()

find_path(SLEEF_INCLUDE_DIR sleef.h REQUIRED)
find_library(SLEEF_LIBRARY sleef REQUIRED)
bergamo_external(bergamo_sleef INCLUDE ${SLEEF_INCLUDE_DIR} LINK ${SLEEF_LIBRARY})

# deal.II on Debian links the Open MPI build of HDF5; the serial build beside it breaks at run time. CMake's own module
# for HDF5 asks a compiler wrapper, which fails in a folder whose path has a space.
include(CheckSymbolExists)
find_package(MPI REQUIRED COMPONENTS C)
find_path(HDF5_INCLUDE_DIR hdf5.h PATH_SUFFIXES hdf5/openmpi REQUIRED)
find_library(HDF5_LIBRARY hdf5 PATH_SUFFIXES hdf5/openmpi REQUIRED)
set(CMAKE_REQUIRED_INCLUDES ${HDF5_INCLUDE_DIR})
set(CMAKE_REQUIRED_LIBRARIES MPI::MPI_C)
check_symbol_exists(H5_HAVE_PARALLEL hdf5.h HDF5_HAS_MPI)
unset(CMAKE_REQUIRED_INCLUDES)
unset(CMAKE_REQUIRED_LIBRARIES)
if(NOT HDF5_HAS_MPI)
  unset(HDF5_HAS_MPI CACHE)
  message(FATAL_ERROR "HDF5 without MPI found (${HDF5_LIBRARY}): install libhdf5-openmpi-dev")
endif()
bergamo_external(bergamo_hdf5 INCLUDE ${HDF5_INCLUDE_DIR} LINK ${HDF5_LIBRARY} MPI::MPI_C)

if(BERGAMO_WITH_GMSH)
  find_path(GMSH_INCLUDE_DIR gmsh.h)
  find_library(GMSH_LIBRARY gmsh)
  if(NOT GMSH_INCLUDE_DIR OR NOT GMSH_LIBRARY)
    message(FATAL_ERROR "Gmsh was not found: install libgmsh-dev, or configure with -DBERGAMO_WITH_GMSH=OFF to do "
      "without its meshes as surfaces")
  endif()
  # Only programs that read surfaces load it: it brings 90 libraries, a tenth of a second at each start.
  bergamo_external(bergamo_gmsh INCLUDE ${GMSH_INCLUDE_DIR}
    LINK "-Wl,--push-state,--as-needed,${GMSH_LIBRARY},--pop-state")
endif()
