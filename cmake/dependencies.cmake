find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)

# deal.II on Debian links the Open MPI build of HDF5; the serial build beside it breaks at run time.
find_package(MPI REQUIRED COMPONENTS C)
set(HDF5_PREFER_PARALLEL TRUE)
set(HDF5_C_COMPILER_EXECUTABLE h5pcc)
find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 without MPI found (${HDF5_C_LIBRARIES}): install libhdf5-openmpi-dev")
endif()
add_library(bergamo_hdf5 INTERFACE)
target_include_directories(bergamo_hdf5 SYSTEM INTERFACE ${HDF5_INCLUDE_DIRS})
target_link_libraries(bergamo_hdf5 INTERFACE ${HDF5_C_LIBRARIES} MPI::MPI_C)

if(BERGAMO_WITH_FE)
  find_package(deal.II 9.4 REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  # Only the libraries and the include paths: deal.II's exported flags would override ours (-std, -O).
  add_library(bergamo_dealii INTERFACE)
  target_include_directories(bergamo_dealii SYSTEM INTERFACE ${DEAL_II_INCLUDE_DIRS})
  target_link_libraries(bergamo_dealii INTERFACE ${DEAL_II_TARGET_RELEASE})
  # deal.II's headers call Trilinos' Teuchos, which Debian's target names only through the library itself.
  target_link_options(bergamo_dealii INTERFACE -Wl,--copy-dt-needed-entries)
endif()
if(BERGAMO_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
