# What `cmake --install` brings, by component: dem (grains), fe (continuum), coupling, python (the package bergamo, see
# drivers/python). Libraries are static; headers lie in include/bergamo and are included as here,
# "dem/simulation/simulation.h".
# The drivers stay in the build: they start scripts of the checkout.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Bergamo)

# bergamo_install(<component> FOLDER <folder of headers> TARGETS ...): target bergamo_NAME becomes Bergamo::NAME.
function(bergamo_install component)
  cmake_parse_arguments(arg "" "FOLDER" "TARGETS" ${ARGN})
  foreach(target ${arg_TARGETS})
    string(REPLACE bergamo_ "" name ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  endforeach()
  install(TARGETS ${arg_TARGETS} EXPORT Bergamo_${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bergamo)
  install(EXPORT Bergamo_${component} FILE Bergamo_${component}.cmake NAMESPACE Bergamo:: DESTINATION ${config_dir}
    COMPONENT ${component})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${arg_FOLDER} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bergamo
    COMPONENT ${component} FILES_MATCHING PATTERN "*.h")
endfunction()

bergamo_install(dem FOLDER dem TARGETS bergamo_core bergamo_dem_step bergamo_dem)
if(BERGAMO_WITH_FE)
  bergamo_install(fe FOLDER fe_dealii TARGETS bergamo_fe)
  bergamo_install(coupling FOLDER coupling TARGETS bergamo_coupling bergamo_adapter)
endif()

# The width of a pack is part of the interface: a program of another one would go wrong at run time.
include(CheckCXXSourceCompiles)
foreach(width 8 4 2)
  set(CMAKE_REQUIRED_FLAGS "-std=c++20 ${BERGAMO_ARCH_FLAG}")
  check_cxx_source_compiles("#include <experimental/simd>
    static_assert(std::experimental::native_simd<double>::size() == ${width}); int main() {}" BERGAMO_HAS_PACKS_OF_${width})
  unset(CMAKE_REQUIRED_FLAGS)
  if(BERGAMO_HAS_PACKS_OF_${width})
    set(BERGAMO_PACK_WIDTH ${width})
    break()
  endif()
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/BergamoConfig.cmake.in
  ${PROJECT_BINARY_DIR}/BergamoConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/BergamoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/BergamoConfig.cmake ${PROJECT_BINARY_DIR}/BergamoConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/dem_libraries.cmake DESTINATION ${config_dir} COMPONENT dem)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/fe_libraries.cmake DESTINATION ${config_dir} COMPONENT fe)

# Programs and tests are not installed: an installation does not wait for them.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)

# `cpack -G TGZ` or `-G DEB` in the build: all components in one archive. For other machines than this one, configure
# with -DBERGAMO_ARCH=x86-64-v3.
set(CPACK_PACKAGE_NAME bergamo-dev)
set(CPACK_PACKAGE_CONTACT "Bergamo's developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Two-scale granular mechanics: libraries, headers, Python package")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR TGZ DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX}) # where Python looks, see drivers/python
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "g++, libboost-dev, libeigen3-dev, libhdf5-openmpi-dev, libsleef-dev, zlib1g-dev, python3-numpy")
if(BERGAMO_WITH_GMSH)
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", libgmsh-dev")
endif()
if(BERGAMO_WITH_FE)
  string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", libdeal.ii-dev")
endif()
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3-h5py, python3-matplotlib, python3-vtk9")
include(CPack)
