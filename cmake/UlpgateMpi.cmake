# Whether ulpgate-mpi is built.  Sets MPI_CXX_FOUND and MPI::MPI_CXX where it is.

set(ULPGATE_MPI AUTO CACHE STRING "Build ulpgate-mpi: ON, OFF, or AUTO (where MPI is found, and no sanitizer is on)")
set_property(CACHE ULPGATE_MPI PROPERTY STRINGS ON OFF AUTO)

# Says why there is no ulpgate-mpi: an error where it was asked for.
function(ulpgate_without_mpi reason)
  if(ULPGATE_MPI STREQUAL "ON")
    message(FATAL_ERROR "ULPGATE_MPI=ON: ${reason}")
  endif()
  message(STATUS "ulpgate-mpi is not built: ${reason}")
endfunction()

# Debian's openmpi-bin brings the compiler wrapper without the headers it names, and FindMPI then stops the
# configuration, QUIET or not.  So the wrapper is asked first; one that is mended later is asked again.
function(ulpgate_find_mpi_wrapper)
  find_program(MPI_CXX_COMPILER NAMES mpicxx mpiCC mpcxx mpCC mpic++ HINTS ${MPI_HOME} ENV MPI_HOME PATH_SUFFIXES bin
    DOC "MPI's C++ compiler wrapper")
  set(ULPGATE_MPI_WRAPPER_BROKEN OFF PARENT_SCOPE)
  if(MPI_CXX_COMPILER)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/mpi_header.cpp)
    file(WRITE ${source} "#include <mpi.h>\n")
    execute_process(COMMAND ${MPI_CXX_COMPILER} -fsyntax-only ${source}
      RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(failed)
      set(ULPGATE_MPI_WRAPPER_BROKEN ON PARENT_SCOPE)
    endif()
  endif()
endfunction()

if(ULPGATE_MPI STREQUAL "OFF")
  # As asked.
elseif(NOT ULPGATE_MPI MATCHES "^(ON|AUTO)$")
  message(FATAL_ERROR "ULPGATE_MPI must be ON, OFF or AUTO, not '${ULPGATE_MPI}'")
elseif(ULPGATE_MPI STREQUAL "AUTO" AND CMAKE_CXX_FLAGS_RELEASE MATCHES "fsanitize")
  # MPI's own leaks and races are not what a sanitised build looks for.
  message(STATUS "ulpgate-mpi is not built: a sanitizer is on")
else()
  ulpgate_find_mpi_wrapper()
  if(ULPGATE_MPI_WRAPPER_BROKEN)
    ulpgate_without_mpi("${MPI_CXX_COMPILER} does not find <mpi.h>; Debian has it in libopenmpi-dev")
  else()
    find_package(MPI QUIET COMPONENTS CXX)
    if(NOT MPI_CXX_FOUND)
      ulpgate_without_mpi("no MPI was found; Debian has it in openmpi-bin and libopenmpi-dev")
    endif()
  endif()
endif()
