# One set of flags for every target: Eigen's alignment depends on them, so mixing breaks at run time.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_compile_options(-Wall -Wextra -fno-math-errno -fno-trapping-math)
# One machine code for programs and for Python's module, which is a shared object: the same bits and the same speed. The
# second flag lets functions be inlined as in a program.
add_compile_options(-fPIC -fno-semantic-interposition)
# g++ cleans up its memory only above 1 GB [kB]: a tenth of its time.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1000000>)
set_property(CACHE BERGAMO_ARCH PROPERTY STRINGS native x86-64-v2 x86-64-v3 x86-64-v4 none)
if(BERGAMO_ARCH AND NOT BERGAMO_ARCH STREQUAL "none")
  include(CheckCXXCompilerFlag)
  unset(BERGAMO_ARCH_IS_KNOWN CACHE)
  set(CMAKE_REQUIRED_QUIET TRUE)
  check_cxx_compiler_flag(-march=${BERGAMO_ARCH} BERGAMO_ARCH_IS_KNOWN)
  unset(CMAKE_REQUIRED_QUIET)
  if(NOT BERGAMO_ARCH_IS_KNOWN)
    message(FATAL_ERROR "BERGAMO_ARCH: the compiler knows no -march=${BERGAMO_ARCH}; "
      "native, x86-64-v2, x86-64-v3, x86-64-v4 and none are usual")
  endif()
  set(BERGAMO_ARCH_FLAG -march=${BERGAMO_ARCH})
  add_compile_options(${BERGAMO_ARCH_FLAG})
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEV "-O2 -g")

# Beside deal.II's 200 libraries it links in a third of the time of the usual linker.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold BERGAMO_LINKS_BY_GOLD)
if(BERGAMO_LINKS_BY_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

set(BERGAMO_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")
if(BERGAMO_SANITIZE)
  add_compile_options(-fsanitize=${BERGAMO_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${BERGAMO_SANITIZE})
endif()
