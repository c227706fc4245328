# Unity builds: the sources of a room, or of several that a target names together, in one translation unit, so that the
# headers and templates that they share are compiled once, which takes a quarter off a build from nothing, and some more
# where rooms stand together (decision 221).  On by default, so that two names that meet are seen by whoever wrote them; who
# changes one source again and again may rather have it OFF.
# Code of one type is compiled apart from that of others either way, and what different parts of the gate use apart as well:
# what a change can affect is read from dependencies (scripts/merge/changed_since.py).

option(ULPGATE_UNITY "Compile the sources of a room in one translation unit" ON)

# ulpgate_unity(TARGET [NAME=ROOM,ROOM...]...): each room by itself, but for those that stand in a group, by the ends of
# their paths; the first group that names a room has it.
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
    string(MAKE_C_IDENTIFIER "${room}" name)
    foreach(group IN LISTS ARGN)
      string(REGEX MATCH "^[^=]+" group_name "${group}")
      string(REGEX REPLACE "^[^=]+=" "" rooms "${group}")
      string(REPLACE "," "|" rooms "${rooms}")
      if(room MATCHES "/(${rooms})$")
        set(name ${target}_${group_name})
        break()
      endif()
    endforeach()
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name})
  endforeach()
endfunction()
