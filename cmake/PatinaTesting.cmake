# Sanitizers slow tests down, and a report that a decoder (a worker) printed about our own code
# fails the test that fed it, even one that expects an error.
set(PATINA_FAILING_OUTPUT "\\[  SKIPPED \\]")
set(PATINA_TIMEOUT_FACTOR 1)
set(PATINA_SANITIZER_ENVIRONMENT)
if(PATINA_SANITIZERS)
  list(APPEND PATINA_FAILING_OUTPUT
    "runtime error: "
    "SUMMARY: [A-Za-z]+Sanitizer: [^\n]*/(core|app)/"
    # the access itself, or memcpy and its like called by it
    "(READ|WRITE) of size [^\n]*\n *#0 [^\n]*(\n *#1 [^\n]*)?/(core|app)/")
  set(PATINA_TIMEOUT_FACTOR 4)
  set(PATINA_SANITIZER_ENVIRONMENT
    "UBSAN_OPTIONS=print_stacktrace=1"
    "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/lsan.supp"
    "TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/tsan.supp")
endif()

# Compiling tests would take longer than running them: they are optimized a little only, and not at all
# where all that takes time is in the editor (a third less to compile; WINDOW). -pthread makes all of them
# reuse the same precompiled headers: some libraries bring it and others do not.
function(patina_test_options target)
  if("WINDOW" IN_LIST ARGN)
    set(level -O0)
  else()
    set(level -O1)
  endif()
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${level}> -pthread)
endfunction()

# What all tests run with. Software OpenGL takes seconds to compile the editor's programs, so the driver's
# compiled shaders are kept in one folder for all tests, none of which starts with an editor that counts
# on them. So is the light of environments, named by all that it is computed from. Settings and the other
# caches of the editor are each test's own.
# Optimizing shaders (LLVM behind llvmpipe) costs a third more than running them gains here, and memory that
# is given back and taken again costs page faults: large pages, and what was allocated is kept.
set(PATINA_TEST_GALLIVM_PERF nopt CACHE STRING "GALLIVM_PERF of tests; empty: not set (scripts/check-steadiness)")
if(PATINA_TEST_GALLIVM_PERF)
  set(gallivm GALLIVM_PERF=${PATINA_TEST_GALLIVM_PERF})
endif()
set(PATINA_TEST_ENVIRONMENT
  "PATINA_BIN_DIR=${CMAKE_BINARY_DIR}/bin"
  "LP_NUM_THREADS=2"
  ${gallivm}
  "GLIBC_TUNABLES=glibc.malloc.hugetlb=1:glibc.malloc.mmap_threshold=1073741824:glibc.malloc.trim_threshold=2147483648"
  "XDG_RUNTIME_DIR=${CMAKE_BINARY_DIR}/run"
  "MESA_SHADER_CACHE_DIR=${CMAKE_BINARY_DIR}/tests/shader-cache"
  "PATINA_LIGHT_CACHE=${CMAKE_BINARY_DIR}/tests/light-cache"
  "PATINA_RADIOSITY_CACHE=" # nowhere: tests of radiosity solve
  "XDG_STATE_HOME=${CMAKE_BINARY_DIR}/tests/state" # of projects that tests save
  ${PATINA_SANITIZER_ENVIRONMENT})

# The longest tests begin first in a fresh build folder, too, where ctest has measured none yet: the last
# minutes have work for every processor. Seconds, of which the order alone counts; what ctest has measured
# overrides them.
set(PATINA_COST_90 test_editor_library test_radiosity test_renderer test_wall_window)
set(PATINA_COST_50 test_editor_docks test_editor_ladder test_equation test_explanation test_incremental
  test_long_picture test_recovery_runs test_render_and_bake test_trace test_trace_bias test_viewport_window)
set(PATINA_COST_30 test_bake_manager test_cli test_editor_window test_environment_command test_ibl_updater
  test_light test_lighting test_near_shadow_window test_path_window test_pixel_window test_sheet test_views)
function(patina_test_cost name entry)
  foreach(seconds IN ITEMS 90 50 30)
    if(name IN_LIST PATINA_COST_${seconds})
      set_tests_properties(${entry} PROPERTIES COST ${seconds})
    endif()
  endforeach()
endfunction()

# Cases that only scripts/test --all runs (tests/nightly.txt): a program's own entries leave them out, one
# entry more, NAME_nightly, runs just them.
set(PATINA_NIGHTLY_LIST ${CMAKE_SOURCE_DIR}/tests/nightly.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PATINA_NIGHTLY_LIST})
file(STRINGS ${PATINA_NIGHTLY_LIST} PATINA_NIGHTLY REGEX "^test_")
# patina_nightly_filter(NAME VARIABLE): the program's nightly cases as GoogleTest's filter, or "".
function(patina_nightly_filter name variable)
  set(cases)
  foreach(line IN LISTS PATINA_NIGHTLY)
    if(line MATCHES "^${name} +([^ ]+) ")
      list(APPEND cases ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN cases ":" filter)
  set(${variable} "${filter}" PARENT_SCOPE)
endfunction()

# patina_test_support(NAME [WINDOW]): a static library that tests share. Compiled like a program, so that tests
# can reuse the headers it precompiles.
function(patina_test_support name)
  add_library(${name} STATIC)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  # Objects of their own: a test that has its own main() does not link the one that is here.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF UNITY_BUILD OFF)
  target_link_libraries(${name} PRIVATE patina_compiler)
  target_compile_options(${name} PRIVATE -fPIE)
  patina_test_options(${name} ${ARGN})
endfunction()

# patina_test(NAME LABEL core|render|app SOURCES … LIBRARIES … [TIMEOUT s] [SHARDS n])
# One GoogleTest program, one ctest entry; SHARDS entries NAME_1, NAME_2 … that share its cases where
# they take long enough to hold up the end on one processor.
function(patina_test name)
  cmake_parse_arguments(T "" "LABEL;TIMEOUT;SHARDS" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 600)
  endif()
  if(NOT T_SHARDS)
    set(T_SHARDS 1)
  endif()
  patina_executable(${name})
  target_sources(${name} PRIVATE ${T_SOURCES})
  target_link_libraries(${name} PRIVATE ${T_LIBRARIES} patina_core GTest::gmock GTest::gtest_main)
  if(patina_editor_lib IN_LIST T_LIBRARIES)
    patina_test_options(${name} WINDOW)
    target_link_libraries(${name} PRIVATE Qt6::Test)
    patina_reuse_precompiled(${name} patina_gui_test_support)
  else()
    patina_test_options(${name})
    patina_reuse_precompiled(${name} patina_core_test_support)
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  math(EXPR timeout "${T_TIMEOUT} * ${PATINA_TIMEOUT_FACTOR}")
  patina_nightly_filter(${name} nightly)
  if(nightly)
    add_test(NAME ${name}_nightly COMMAND ${name})
    set_tests_properties(${name}_nightly PROPERTIES LABELS "nightly" TIMEOUT ${timeout}
      FAIL_REGULAR_EXPRESSION "${PATINA_FAILING_OUTPUT}"
      ENVIRONMENT "${PATINA_TEST_ENVIRONMENT};GTEST_FILTER=${nightly}")
    set(nightly "GTEST_FILTER=-${nightly}")
  endif()
  foreach(shard RANGE 1 ${T_SHARDS})
    set(entry ${name})
    set(shards)
    if(T_SHARDS GREATER 1)
      set(entry ${name}_${shard})
      math(EXPR index "${shard} - 1")
      set(shards GTEST_TOTAL_SHARDS=${T_SHARDS} GTEST_SHARD_INDEX=${index})
    endif()
    add_test(NAME ${entry} COMMAND ${name})
    patina_test_cost(${name} ${entry})
    set_tests_properties(${entry} PROPERTIES LABELS "${T_LABEL}" TIMEOUT ${timeout}
      FAIL_REGULAR_EXPRESSION "${PATINA_FAILING_OUTPUT}"
      ENVIRONMENT "${PATINA_TEST_ENVIRONMENT};${shards};${nightly}")
  endforeach()
endfunction()

# patina_golden(NAME): the test NAME compares pictures with tests/golden/*.png (through a worker)
# and leaves what differs in build/<preset>/golden. PATINA_UPDATE_GOLDEN=1 in the environment
# accepts the new pictures.
function(patina_golden name)
  target_compile_definitions(${name} PRIVATE
    PATINA_GOLDEN_DIR="${CMAKE_SOURCE_DIR}/tests/golden"
    PATINA_GOLDEN_OUTPUT_DIR="${CMAKE_BINARY_DIR}/golden")
  add_dependencies(${name} patina-workers)
endfunction()

# patina_gui_test(NAME SOURCES … LIBRARIES …): a GoogleTest program with a window, on an X server of
# its own (tests/support/with-xvfb). Brings its main() and the editor's fixture from
# patina_gui_test_support. Pictures that a test takes are kept in tests/screenshots of the build folder.
function(patina_gui_test name)
  cmake_parse_arguments(T "" "TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 600)
  endif()
  patina_executable(${name})
  target_sources(${name} PRIVATE ${T_SOURCES})
  target_link_libraries(${name} PRIVATE
    ${T_LIBRARIES} patina_gui_test_support patina_editor_lib Qt6::Test GTest::gmock)
  patina_test_options(${name} WINDOW)
  patina_reuse_precompiled(${name} patina_gui_test_support)
  add_dependencies(${name} patina-workers)
  set_target_properties(${name} PROPERTIES
    RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  patina_nightly_filter(${name} nightly)
  set(entries ${name})
  set(label_${name} app)
  if(nightly)
    list(APPEND entries ${name}_nightly)
    set(label_${name}_nightly nightly)
    set(filter_${name} "GTEST_FILTER=-${nightly}")
    set(filter_${name}_nightly "GTEST_FILTER=${nightly}")
  endif()
  foreach(entry IN LISTS entries)
    add_test(NAME ${entry} COMMAND ${CMAKE_SOURCE_DIR}/tests/support/with-xvfb $<TARGET_FILE:${name}>)
    set_tests_properties(${entry} PROPERTIES LABELS ${label_${entry}} TIMEOUT ${T_TIMEOUT}
      FAIL_REGULAR_EXPRESSION "\\[  SKIPPED \\]"
      ENVIRONMENT "${PATINA_TEST_ENVIRONMENT};PATINA_SCREENSHOTS=${CMAKE_BINARY_DIR}/tests/screenshots;${filter_${entry}}")
  endforeach()
  patina_test_cost(${name} ${name})
endfunction()

# patina_on_demand(TARGET): built by name, or with everything else of its kind by the target `tools`,
# which scripts/test --all builds.
add_custom_target(tools)
function(patina_on_demand target)
  set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)
  add_dependencies(tools ${target})
endfunction()

# patina_benchmark(NAME SOURCES … LIBRARIES …): a Google Benchmark program, built on demand; never run
# by ctest.
function(patina_benchmark name)
  if(NOT PATINA_BENCHMARKS)
    return()
  endif()
  cmake_parse_arguments(B "" "" "SOURCES;LIBRARIES" ${ARGN})
  patina_executable(${name})
  target_sources(${name} PRIVATE ${B_SOURCES})
  target_link_libraries(${name} PRIVATE ${B_LIBRARIES} benchmark::benchmark benchmark::benchmark_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/benchmarks)
  patina_on_demand(${name})
endfunction()

file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/tests/shader-cache)
file(REMOVE_RECURSE ${CMAKE_BINARY_DIR}/tests/light-cache) # who works on it configures, and begins anew
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/run)
file(CHMOD ${CMAKE_BINARY_DIR}/run PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
