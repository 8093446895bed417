# One interface target carries the warnings and sanitizers every Patina target is built with.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

# Modules of loops over numbers ask for more (patina_module(… NUMERIC)), tests for less; what reads files
# and draws panels would only take longer to compile. Here and not among the options of a target: those
# come later, and the last one counts.
string(REPLACE -O3 -O2 CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")

add_library(patina_compiler INTERFACE)
target_compile_options(patina_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual)
# Messages name files as seen from the checkout, so that objects are the same wherever it lies: unity sources
# include by absolute paths, and ccache would find nothing for another clone.
target_compile_options(patina_compiler INTERFACE -fmacro-prefix-map=${CMAKE_SOURCE_DIR}/=)
if(PATINA_WARNINGS_AS_ERRORS)
  target_compile_options(patina_compiler INTERFACE -Werror)
endif()

if(PATINA_SANITIZERS)
  target_compile_options(patina_compiler INTERFACE
    -fsanitize=${PATINA_SANITIZERS} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(patina_compiler INTERFACE -fsanitize=${PATINA_SANITIZERS})
  # GCC 12's flow analysis reports false positives in standard headers under the sanitizers.
  target_compile_options(patina_compiler INTERFACE -Wno-maybe-uninitialized -Wno-restrict)
  # GCC warns that TSan does not model atomic_thread_fence (TBB's headers use it).
  if(PATINA_SANITIZERS MATCHES "thread")
    target_compile_options(patina_compiler INTERFACE -Wno-tsan)
  endif()
endif()

# Several sources of a target are compiled at a time: headers of libraries and templates once for all of
# them, which halves the time from scratch. Local names are therefore unique within a target. For work on
# single sources, build without (the preset dev does).
option(PATINA_UNITY "Compile several sources of a target at a time" ON)
set(CMAKE_UNITY_BUILD ${PATINA_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
if(PATINA_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Each source is a header there: a local of one that is named like a constant of another shadows nothing,
  # and a type of one source alone may have members of that source's own types.
  target_compile_options(patina_compiler INTERFACE -Wno-shadow -Wshadow=local -Wno-subobject-linkage)
endif()

find_program(PATINA_CCACHE ccache)
if(PATINA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What ccache wants to be told before it stores objects compiled with precompiled headers; and that paths
  # below the checkout are relative for it, so that another clone finds what this one compiled.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros
    CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=true ${PATINA_CCACHE})
endif()

find_program(PATINA_MOLD mold)
if(PATINA_MOLD)
  target_link_options(patina_compiler INTERFACE -fuse-ld=mold)
endif()

# patina_library(NAME): a static library compiled with the house's flags, whose headers are
# included from the repository's root ("core/image/Image.h").
function(patina_library name)
  add_library(${name} STATIC)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE patina_compiler)
endfunction()

# patina_executable(NAME): a program in build/<preset>/bin.
function(patina_executable name)
  add_executable(${name})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE patina_compiler)
endfunction()
