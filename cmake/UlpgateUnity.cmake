# Unity builds: several sources of a room in one translation unit, so that the headers and templates that they share are
# compiled once, which takes a quarter off a build from nothing.  On by default, so that two names that meet in a unit are
# seen by whoever wrote them; who changes one source again and again may rather have it OFF.  Code of one type keeps
# a translation unit of its own either way: what a change can affect is read from its dependencies
# (scripts/changed_since.py).  Tests do as well, since their helpers have the same names everywhere.

option(ULPGATE_UNITY "Compile several sources of a room in one translation unit" ON)

# ulpgate_unity(TARGET SOURCES_A_UNIT [SOURCE_LEFT_OUT...])
function(ulpgate_unity target sources)
  if(NOT ULPGATE_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${sources})
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
