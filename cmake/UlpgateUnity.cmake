# Unity builds: the sources of a room in one translation unit, so that the headers and templates that they share are compiled
# once, which takes a quarter off a build from nothing.  On by default, so that two names that meet in a room are seen by
# whoever wrote them; who changes one source again and again may rather have it OFF.  Code of one type is compiled apart
# from that of others either way, and what different parts of the gate use apart as well: what a change can affect is read
# from dependencies (scripts/merge/changed_since.py).

option(ULPGATE_UNITY "Compile the sources of a room in one translation unit" ON)

# ulpgate_unity(TARGET)
function(ulpgate_unity target)
  if(NOT ULPGATE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    # A source without a group is compiled alone: what CMake generates, that of one type above all.
    cmake_path(IS_PREFIX CMAKE_BINARY_DIR ${path} generated)
    if(generated)
      continue()
    endif()
    cmake_path(GET path PARENT_PATH room)
    cmake_path(RELATIVE_PATH room BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(MAKE_C_IDENTIFIER "${room}" room)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
endfunction()
