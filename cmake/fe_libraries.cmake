# The libraries that whoever links the continuum needs: read by the build, and by the configuration of an installation.
find_package(deal.II 9.4 REQUIRED)
# Only the libraries and the include paths: deal.II's exported flags would override ours (-std, -O).
bergamo_external(bergamo_dealii INCLUDE ${DEAL_II_INCLUDE_DIRS} LINK ${DEAL_II_TARGET_RELEASE})
# Not the C++ interface of MPI, which nobody calls: every source would compile it.
target_compile_definitions(bergamo_dealii INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
# deal.II's headers call Trilinos' Teuchos, which Debian's target names only through the library itself.
target_link_options(bergamo_dealii INTERFACE -Wl,--copy-dt-needed-entries)
