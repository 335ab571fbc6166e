include(dem_libraries)

# Surfaces of triangles from files: CGAL's headers read STL, beside Boost and zlib for VTU and Gmsh for its meshes.
find_path(CGAL_INCLUDE_DIR CGAL/IO/STL.h)
if(NOT CGAL_INCLUDE_DIR)
  message(FATAL_ERROR "CGAL's headers were not found: install libcgal-dev")
endif()

if(BERGAMO_WITH_FE)
  include(fe_libraries)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
endif()
if(BERGAMO_TESTS)
  find_package(Catch2 2.13 REQUIRED)
endif()
