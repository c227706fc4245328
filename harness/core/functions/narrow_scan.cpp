// The costs of narrow scans.
#include "harness/core/functions/narrow_scan.hpp"

namespace ulpgate {

namespace {

// Of 2^10 to 2^15 arguments a block, so that a row of 1250 of them takes about a second of one core: most
// functions take 40 to 100 ns an argument in double and x87's long double together, 15 to 30 ns in float and
// double.
std::size_t block_of_binary64(FunctionId id) {
  switch (id) {
    case FunctionId::fma:
      return 0;  // x87 has no fused product: nothing is known of the reference
    case FunctionId::fmod:
    case FunctionId::pow:
    case FunctionId::tgamma:
      return 1024;  // 450 to 550 ns
    case FunctionId::remainder:
      return 4096;
    default:
      return 8192;
  }
}

std::size_t block_of_binary32(FunctionId id) {
  switch (id) {
    case FunctionId::fmod:
      return 2048;
    case FunctionId::remainder:
    case FunctionId::tgamma:
      return 8192;
    default:
      return 32768;
  }
}

}  // namespace

std::size_t narrow_block(const FunctionInfo& f, bool binary32) {
  if (f.function_class != FunctionClass::real) return 0;
  if (binary32) return bounded_function<double>(f.id) == nullptr ? 0 : block_of_binary32(f.id);
  if constexpr (has_narrow_scan<double>)
    return bounded_function<long double>(f.id) == nullptr ? 0 : block_of_binary64(f.id);
  return 0;
}

}  // namespace ulpgate
