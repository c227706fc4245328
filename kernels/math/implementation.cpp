// Which code evaluates a function in a Real.
#include "kernels/math/implementation.hpp"

#include <boost/version.hpp>

#include "reference/types/mpfr_value.hpp"
#ifdef __GLIBC__
#include <gnu/libc-version.h>
#endif

namespace ulpgate {

namespace {

std::string version(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

std::string boost_text() {
  return "Boost " + version(BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
}

std::string c_library() {
#ifdef __GLIBC__
  return std::string("glibc ") + gnu_get_libc_version();
#else
  return "C library";
#endif
}

// libquadmath has no version of its own: it comes with the compiler.
std::string compiler_library(const std::string& name) {
#ifdef __GNUC__
  return name + " " + version(__GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
  return name;
#endif
}

bool is_arithmetic(FunctionId id) {
  return id == FunctionId::add || id == FunctionId::sub || id == FunctionId::mul || id == FunctionId::div;
}

std::string native_implementation(const FunctionInfo& f) {
  if (is_arithmetic(f.id)) return "processor";
#ifdef _GLIBCXX_RELEASE
  if (f.function_class == FunctionClass::complex)
    return "libstdc++ " + std::to_string(_GLIBCXX_RELEASE) + " on " + c_library();
#endif
  return c_library();
}

}  // namespace

std::string implementation_of(const FunctionInfo& f, RealFamily family) {
  std::string numbers;
  switch (family) {
    case RealFamily::native:
      numbers = native_implementation(f);
      break;
    case RealFamily::float128:
      numbers = is_arithmetic(f.id) ? compiler_library("libgcc") : compiler_library("libquadmath");
      break;
    case RealFamily::mpfr:
      return boost_text() + " on MPFR " + mpfr_get_version();
    case RealFamily::cpp_bin_float:
      return boost_text();
  }
  // The templates of Boost call the type's own functions.
  return f.function_class == FunctionClass::special ? boost_text() + " on " + numbers : numbers;
}

std::optional<double> claimed_ulp(const FunctionInfo& f, RealFamily family) {
  const bool native_ieee =
      family == RealFamily::native && (f.id == FunctionId::sqrt || f.id == FunctionId::fma);
  return is_arithmetic(f.id) || native_ieee ? std::optional(0.5) : std::nullopt;
}

}  // namespace ulpgate
