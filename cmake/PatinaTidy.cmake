# `ninja tidy` runs clang-tidy once per source and remembers the result in a stamp, so that the
# second run only looks at what changed.
function(patina_add_tidy_target)
  find_program(PATINA_CLANG_TIDY NAMES clang-tidy-14 clang-tidy)
  if(NOT PATINA_CLANG_TIDY)
    return()
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${CMAKE_SOURCE_DIR}/core/*.cpp ${CMAKE_SOURCE_DIR}/render/*.cpp ${CMAKE_SOURCE_DIR}/app/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS
    ${CMAKE_SOURCE_DIR}/core/*.h ${CMAKE_SOURCE_DIR}/render/*.h ${CMAKE_SOURCE_DIR}/app/*.h
    ${CMAKE_SOURCE_DIR}/shaders/shared/*.glsl)
  set(stamps)
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH relative ${CMAKE_SOURCE_DIR} ${source})
    set(stamp ${CMAKE_BINARY_DIR}/tidy/${relative}.stamp)
    get_filename_component(stampDir ${stamp} DIRECTORY)
    file(MAKE_DIRECTORY ${stampDir})
    add_custom_command(OUTPUT ${stamp}
      COMMAND ${PATINA_CLANG_TIDY} --quiet -p ${CMAKE_BINARY_DIR} ${source}
      COMMAND ${CMAKE_COMMAND} -E touch ${stamp}
      DEPENDS ${source} ${headers} ${CMAKE_SOURCE_DIR}/.clang-tidy
      COMMENT "clang-tidy ${relative}" VERBATIM)
    list(APPEND stamps ${stamp})
  endforeach()
  add_custom_target(tidy DEPENDS ${stamps})
endfunction()
