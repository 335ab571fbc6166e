# The libraries that whoever links the continuum needs: read by the build, and by the configuration of an installation.
find_package(deal.II 9.4 REQUIRED)
# deal.II's headers call these by themselves, which Debian's target names only through the library.
set(dealii_libraries ${DEAL_II_TARGET_RELEASE})
foreach(name ml aztecoo epetra teuchoscomm teuchosparameterlist teuchoscore)
  find_library(TRILINOS_${name}_LIBRARY NAMES trilinos_${name} ${name} REQUIRED)
  list(APPEND dealii_libraries ${TRILINOS_${name}_LIBRARY})
endforeach()
find_library(TBB_LIBRARY tbb REQUIRED)
# Only the libraries and the include paths: deal.II's exported flags would override ours (-std, -O).
bergamo_external(bergamo_dealii INCLUDE ${DEAL_II_INCLUDE_DIRS} LINK ${dealii_libraries} ${TBB_LIBRARY})
# Not the C++ interface of MPI, which nobody calls: every source would compile it.
target_compile_definitions(bergamo_dealii INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
