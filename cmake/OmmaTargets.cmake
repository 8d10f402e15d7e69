# Compiler options and the four ways a target is declared here: library, program, test, benchmark.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(OMMA_CCACHE ccache)
if(OMMA_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${OMMA_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${OMMA_CCACHE})
endif()

# Warnings are errors; listed once, for every target of ours.
add_library(omma_options INTERFACE)
target_compile_options(omma_options INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wshadow
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Wextra-semi>
  # GCC 12 sees overlapping copies in std::string where there are none (GCC bug 105329).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  # GCC tells on 32-bit ARM how its ABI differs from that of GCC 6; nothing here is linked with anything that old.
  $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},arm>:-Wno-psabi>
  # The same bits on every machine: no fused multiply-add behind our back, no fast-math anywhere.
  -ffp-contract=off)
# Eigen's own vectors are fused on ARM whatever the compiler is told, and not on x86-64: without them both
# compute the same bits. What is hot is written with the compiler's vectors (components/extractor/lanes.hpp).
target_compile_definitions(omma_options INTERFACE EIGEN_DONT_VECTORIZE)
target_include_directories(omma_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
if(OMMA_SANITIZE)
  target_compile_options(omma_options INTERFACE -fsanitize=${OMMA_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all
    # The checks between the lines hide from the compiler what is set: its warning is then about nothing.
    -Wno-maybe-uninitialized)
  target_link_options(omma_options INTERFACE -fsanitize=${OMMA_SANITIZE})
endif()

# omma_library(NAME SOURCES a.cpp ... [LIBS ...]): a static library of one folder (header-only without SOURCES).
function(omma_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  if(ARG_SOURCES)
    add_library(${name} STATIC ${ARG_SOURCES})
    target_link_libraries(${name} PUBLIC omma_options ${ARG_LIBS})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE omma_options ${ARG_LIBS})
  endif()
endfunction()

# omma_program(NAME SOURCES ... LIBS ...): an executable in <build>/bin.
function(omma_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE omma_options ${ARG_LIBS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

# omma_test(NAME SOURCES ... [LIBS ...] [TIMEOUT s]): a GoogleTest program; each of its tests is a ctest test.
# Where things are comes from tests/paths.hpp. A test's label is its folder: fsw, ground, ...
function(omma_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE omma_options ${ARG_LIBS} GTest::gtest GTest::gmock GTest::gtest_main)
  if(CMAKE_CROSSCOMPILING_EMULATOR)  # about twenty times slower
    math(EXPR ARG_TIMEOUT "4 * ${ARG_TIMEOUT}")
  endif()
  list(JOIN CMAKE_CROSSCOMPILING_EMULATOR " " emulator)
  file(RELATIVE_PATH label ${PROJECT_SOURCE_DIR}/tests ${CMAKE_CURRENT_SOURCE_DIR})
  string(REGEX REPLACE "/.*" "" label "${label}")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES
    TIMEOUT ${ARG_TIMEOUT} LABELS ${label} ENVIRONMENT "OMMA_LAUNCHER=${emulator}")
endfunction()
