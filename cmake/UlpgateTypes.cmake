# The type list: which Real types are built, and one translation unit per type from a template.

set(ULPGATE_DEFAULT_TYPES float double long_double float128 mpfr62 mpfr150 cpp_bin_float62)
if(NOT ULPGATE_HAVE_FLOAT128)
  list(REMOVE_ITEM ULPGATE_DEFAULT_TYPES float128)
endif()
set(ULPGATE_TYPES "${ULPGATE_DEFAULT_TYPES}" CACHE STRING
  "Real types to build: float double long_double float128, any mpfrN, any cpp_bin_floatN")
set(REAL_DECIMAL_PLACES "" CACHE STRING "Add mpfrN and cpp_bin_floatN with this many decimal digits")
set(REAL_PRECISION_BITS "" CACHE STRING "Add mpfrN and cpp_bin_floatN with at least this many bits")

set(ULPGATE_BUILT_TYPES ${ULPGATE_TYPES})
if(REAL_PRECISION_BITS AND NOT REAL_DECIMAL_PLACES)
  # digits10 = floor((bits - 1) log10 2) guarantees fewer digits than bits; round up so that the bits are reached.
  math(EXPR REAL_DECIMAL_PLACES "(${REAL_PRECISION_BITS} * 30103 + 99999) / 100000")
endif()
if(REAL_DECIMAL_PLACES)
  if(NOT REAL_DECIMAL_PLACES MATCHES "^[1-9][0-9]*$")
    message(FATAL_ERROR "REAL_DECIMAL_PLACES must be a positive integer, not '${REAL_DECIMAL_PLACES}'")
  endif()
  list(APPEND ULPGATE_BUILT_TYPES mpfr${REAL_DECIMAL_PLACES} cpp_bin_float${REAL_DECIMAL_PLACES})
endif()
list(REMOVE_DUPLICATES ULPGATE_BUILT_TYPES)

# Sets `type` to the C++ type of a token inside namespace ulpgate, `text` to the name that `list types` prints and
# `wide` to the RealHP<4> of the type.
function(ulpgate_type_of token type text)
  if(token STREQUAL "float" OR token STREQUAL "double")
    set(t ${token})
    set(x ${token})
  elseif(token STREQUAL "long_double")
    set(t "long double")
    set(x "long double")
  elseif(token STREQUAL "float128" AND ULPGATE_HAVE_FLOAT128)
    set(t "Float128Real")
    set(x "boost::multiprecision::float128")
  elseif(token MATCHES "^mpfr([1-9][0-9]*)$")
    set(t "MpfrReal<${CMAKE_MATCH_1}>")
    set(x "boost mpfr_float_backend<${CMAKE_MATCH_1}>")
  elseif(token MATCHES "^cpp_bin_float([1-9][0-9]*)$")
    set(t "CppBinFloatReal<${CMAKE_MATCH_1}>")
    set(x "boost cpp_bin_float<${CMAKE_MATCH_1}>")
  else()
    message(FATAL_ERROR "ULPGATE_TYPES: '${token}' is not a type this compiler can build "
      "(float double long_double float128 mpfrN cpp_bin_floatN)")
  endif()
  set(${type} "${t}" PARENT_SCOPE)
  set(${text} "${x}" PARENT_SCOPE)
endfunction()
