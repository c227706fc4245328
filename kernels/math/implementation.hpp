// Which code evaluates a function in a Real: the library and its version, as they stand in the records.
#pragma once

#include <optional>
#include <string>

#include "reference/functions/function_info.hpp"
#include "reference/types/real_types.hpp"

namespace ulpgate {

// Who implements the numbers of a type; the libraries behind it follow.
enum class RealFamily { native, float128, mpfr, cpp_bin_float };

template <RealType Real>
[[nodiscard]] constexpr RealFamily family_of() {
  if constexpr (NativeReal<Real>) {
    return RealFamily::native;
  } else if constexpr (Float128Backed<Real>) {
    return RealFamily::float128;
  } else if constexpr (MpfrBacked<Real>) {
    return RealFamily::mpfr;
  } else {
    return RealFamily::cpp_bin_float;
  }
}

// "glibc 2.36", "libquadmath 12.2.0", "Boost 1.81.0 on MPFR 4.2.0", "processor": read from the libraries that
// the program runs with, where they tell.
[[nodiscard]] std::string implementation_of(const FunctionInfo& f, RealFamily family);

// The largest error in ULP over the whole domain that the implementation or a standard promises: 0.5 for the
// arithmetic of every type (IEEE 754-2019, 5.4.1; MPFR and Boost document the same of theirs) and for sqrt
// and fma of the native types.
[[nodiscard]] std::optional<double> claimed_ulp(const FunctionInfo& f, RealFamily family);

}  // namespace ulpgate
