# What a measurement or a scene spends its time in is compiled as the build says (-O2).  The rest (commands, judgements of
# records, references that spend theirs inside MPFR) is compiled with -O1: half the compile time, and the same numbers.

set(ULPGATE_LESS_OPTIMIZED "")
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_CXX_FLAGS_RELEASE MATCHES "-O[23]")
  set(ULPGATE_LESS_OPTIMIZED -O1)
endif()

# ulpgate_optimize_less(TARGET [source...]): the target with -O1, but for the sources named.  These have no precompiled
# header: GCC takes the options of optimisation from it, whatever the command line says.
function(ulpgate_optimize_less target)
  target_compile_options(${target} PRIVATE ${ULPGATE_LESS_OPTIMIZED})
  if(ARGN AND ULPGATE_LESS_OPTIMIZED)
    string(REGEX MATCH "-O[23]" as_built "${CMAKE_CXX_FLAGS_RELEASE}")
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON COMPILE_OPTIONS ${as_built})
  endif()
endfunction()
