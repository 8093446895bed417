# patina_module(NAME [NUMERIC] SOURCES … [DEPENDS module…] [LIBRARIES library…] [PRECOMPILED header…])
# A folder of core/ as a library, patina_core_NAME, which sees the modules it depends on and those below
# them. It must link alone: a program of nothing but all of its objects is linked with it, so that a call
# into a module that is not named here does not build. tests/core/base/BordersTest.cpp holds the includes
# against the same lines. NUMERIC: its loops are what users wait for, and are worth the compiler's time.
function(patina_module name)
  cmake_parse_arguments(M "NUMERIC" "" "SOURCES;DEPENDS;LIBRARIES;PRECOMPILED" ${ARGN})
  string(REPLACE / _ target patina_core_${name})
  list(TRANSFORM M_DEPENDS REPLACE / _)
  list(TRANSFORM M_DEPENDS PREPEND patina_core_)
  patina_library(${target})
  target_sources(${target} PRIVATE ${M_SOURCES})
  target_link_libraries(${target}
    PUBLIC glm::glm fmt::fmt Threads::Threads ${M_DEPENDS}
    PRIVATE ${M_LIBRARIES})
  if(M_NUMERIC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
  endif()
  if(M_PRECOMPILED)
    patina_precompile(${target} ${M_PRECOMPILED})
  else()
    patina_reuse_precompiled(${target} patina_core_precompiled)
  endif()

  if(BUILD_TESTING)
    string(REPLACE / - alone links-alone-${name})
    patina_executable(${alone})
    target_sources(${alone} PRIVATE ${CMAKE_SOURCE_DIR}/tests/support/LinksAlone.cpp)
    target_link_libraries(${alone} PRIVATE "$<LINK_LIBRARY:WHOLE_ARCHIVE,${target}>")
    set_target_properties(${alone} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/links-alone)
  endif()
endfunction()
