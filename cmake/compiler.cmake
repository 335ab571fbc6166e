# One set of flags for every target: Eigen's alignment depends on them, so mixing breaks at run time.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

add_compile_options(-Wall -Wextra -fno-math-errno -fno-trapping-math)
if(BERGAMO_NATIVE)
  add_compile_options(-march=native)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEV "-O2 -g")

set(BERGAMO_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")
if(BERGAMO_SANITIZE)
  add_compile_options(-fsanitize=${BERGAMO_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${BERGAMO_SANITIZE})
endif()
