find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)

find_path(SLEEF_INCLUDE_DIR sleef.h REQUIRED)
find_library(SLEEF_LIBRARY sleef REQUIRED)
add_library(bergamo_sleef INTERFACE)
target_include_directories(bergamo_sleef SYSTEM INTERFACE ${SLEEF_INCLUDE_DIR})
target_link_libraries(bergamo_sleef INTERFACE ${SLEEF_LIBRARY})

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
add_library(bergamo_hdf5 INTERFACE)
target_include_directories(bergamo_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIR})
target_link_libraries(bergamo_hdf5 INTERFACE ${HDF5_LIBRARY} MPI::MPI_C)

# Surfaces of triangles from files: CGAL's headers read STL, Boost's and zlib VTU, Gmsh its meshes.
find_path(CGAL_INCLUDE_DIR CGAL/IO/STL.h)
if(NOT CGAL_INCLUDE_DIR)
  message(FATAL_ERROR "CGAL's headers were not found: install libcgal-dev")
endif()
find_package(ZLIB REQUIRED)
if(BERGAMO_WITH_GMSH)
  find_path(GMSH_INCLUDE_DIR gmsh.h)
  find_library(GMSH_LIBRARY gmsh)
  if(NOT GMSH_INCLUDE_DIR OR NOT GMSH_LIBRARY)
    message(FATAL_ERROR "Gmsh was not found: install libgmsh-dev, or configure with -DBERGAMO_WITH_GMSH=OFF to do "
      "without its meshes as surfaces")
  endif()
  add_library(bergamo_gmsh INTERFACE)
  target_include_directories(bergamo_gmsh SYSTEM INTERFACE ${GMSH_INCLUDE_DIR})
  # Only programs that read surfaces load it: it brings 90 libraries, a tenth of a second at each start.
  target_link_libraries(bergamo_gmsh INTERFACE "-Wl,--push-state,--as-needed,${GMSH_LIBRARY},--pop-state")
endif()

if(BERGAMO_WITH_FE)
  find_package(deal.II 9.4 REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  # Only the libraries and the include paths: deal.II's exported flags would override ours (-std, -O).
  add_library(bergamo_dealii INTERFACE)
  target_include_directories(bergamo_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
  target_link_libraries(bergamo_dealii INTERFACE ${DEAL_II_TARGET_RELEASE})
  # Not the C++ interface of MPI, which nobody calls: every source would compile it.
  target_compile_definitions(bergamo_dealii INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  # deal.II's headers call Trilinos' Teuchos, which Debian's target names only through the library itself.
  target_link_options(bergamo_dealii INTERFACE -Wl,--copy-dt-needed-entries)
endif()
if(BERGAMO_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
