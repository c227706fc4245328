// libmvec is looked up when it is first wanted: nothing is linked to it, and a machine without it does
// without.
#include "reference/native/vector_functions.hpp"

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_LIBMVEC
#include <dlfcn.h>
#include <immintrin.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#endif

namespace ulpgate {

#ifdef ULPGATE_LIBMVEC

namespace {

using Four = __m256d (*)(__m256d);
using Eight = __m512d (*)(__m512d);

// Names by the x86_64 vector function ABI: the instruction set, lanes, and one vector argument.
void* find(const char* prefix, FunctionId id) {
  static void* const library = dlopen("libmvec.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return nullptr;
  return dlsym(library, (prefix + std::string(info_of(id).name)).c_str());
}

template <FunctionId Id>
Four four() {
  static const auto f = reinterpret_cast<Four>(find("_ZGVdN4v_", Id));
  return f;
}
template <FunctionId Id>
Eight eight() {
  static const auto f = reinterpret_cast<Eight>(find("_ZGVeN8v_", Id));
  return f;
}

// For one argument out of its range libmvec calls the scalar function, for slow errno as well.  What is below
// `least` or above `greatest` is answered here, by the value that f has there to more than binary64 says:
// infinity beyond its range, 0 below its least normal number, NaN outside the domain.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  double below = 0;
  double above = 0;
  double inside = 0.5;  // an argument in the range
};

constexpr Range range_of(FunctionId id) {
  using enum FunctionId;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  switch (id) {
    case exp:
      return {-708.5, 709.79, 0, infinity};
    case exp2:
      return {-1022.5, 1024, 0, infinity};
    case expm1:
      return {-40, 709.79, -1, infinity};
    case sinh:
      return {-710.5, 710.5, -infinity, infinity};
    case cosh:
      return {-710.5, 710.5, infinity, infinity};
    case tanh:
      return {-22, 22, -1, 1};
    case erf:
      return {-6, 6, -1, 1};
    case erfc:
      return {-6, 27, 2, 0};
    case log:
    case log2:
    case log10:
      return {0, infinity, none, none};
    case log1p:
      return {-1, infinity, none, none};
    case acosh:
      return {1, infinity, none, none, 2};
    case asin:
    case acos:
    case atanh:
      return {-1, 1, none, none};
    default:
      return {};
  }
}

template <FunctionId Id>
__attribute__((target("avx512f"))) inline __m512d eight_at(Eight f, __m512d x) {
  constexpr Range range = range_of(Id);
  const __mmask8 below = _mm512_cmp_pd_mask(x, _mm512_set1_pd(range.least), _CMP_LT_OQ);
  const __mmask8 above = _mm512_cmp_pd_mask(x, _mm512_set1_pd(range.greatest), _CMP_GT_OQ);
  const __mmask8 outside = below | above;
  if (outside == 0) return f(x);
  __m512d result = x;
  if (outside != 0xff) result = f(_mm512_mask_mov_pd(x, outside, _mm512_set1_pd(range.inside)));
  result = _mm512_mask_mov_pd(result, below, _mm512_set1_pd(range.below));
  return _mm512_mask_mov_pd(result, above, _mm512_set1_pd(range.above));
}

template <FunctionId Id>
__attribute__((target("avx2"))) inline __m256d four_at(Four f, __m256d x) {
  constexpr Range range = range_of(Id);
  const __m256d below = _mm256_cmp_pd(x, _mm256_set1_pd(range.least), _CMP_LT_OQ);
  const __m256d above = _mm256_cmp_pd(x, _mm256_set1_pd(range.greatest), _CMP_GT_OQ);
  const __m256d outside = _mm256_or_pd(below, above);
  const int lanes = _mm256_movemask_pd(outside);
  if (lanes == 0) return f(x);
  __m256d result = x;
  if (lanes != 0xf) result = f(_mm256_blendv_pd(x, _mm256_set1_pd(range.inside), outside));
  result = _mm256_blendv_pd(result, _mm256_set1_pd(range.below), below);
  return _mm256_blendv_pd(result, _mm256_set1_pd(range.above), above);
}

// The last few points are filled up with ones.
template <FunctionId Id>
__attribute__((target("avx512f"))) void by_eight(const double* args, double* results, std::size_t count) {
  const Eight f = eight<Id>();
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) _mm512_storeu_pd(results + i, eight_at<Id>(f, _mm512_loadu_pd(args + i)));
  if (i == count) return;
  std::array<double, 8> rest = {1, 1, 1, 1, 1, 1, 1, 1};
  std::memcpy(rest.data(), args + i, (count - i) * sizeof(double));
  _mm512_storeu_pd(rest.data(), eight_at<Id>(f, _mm512_loadu_pd(rest.data())));
  std::memcpy(results + i, rest.data(), (count - i) * sizeof(double));
}

template <FunctionId Id>
__attribute__((target("avx2"))) void by_four(const double* args, double* results, std::size_t count) {
  const Four f = four<Id>();
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) _mm256_storeu_pd(results + i, four_at<Id>(f, _mm256_loadu_pd(args + i)));
  if (i == count) return;
  std::array<double, 4> rest = {1, 1, 1, 1};
  std::memcpy(rest.data(), args + i, (count - i) * sizeof(double));
  _mm256_storeu_pd(rest.data(), four_at<Id>(f, _mm256_loadu_pd(rest.data())));
  std::memcpy(results + i, rest.data(), (count - i) * sizeof(double));
}

template <FunctionId Id>
VectorFunction best(int most_lanes) {
  if (most_lanes >= 8 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      eight<Id>() != nullptr)
    return by_eight<Id>;
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 && four<Id>() != nullptr)
    return by_four<Id>;
  return nullptr;
}

}  // namespace

VectorFunction vector_function(FunctionId id, int most_lanes) {
  switch (id) {
#define REAL1(name, d0, hard, oracle) \
  case FunctionId::name:              \
    return best<FunctionId::name>(most_lanes);
#include "reference/functions/functions.def"
    default:
      return nullptr;
  }
}

#else

VectorFunction vector_function(FunctionId, int) {
  return nullptr;
}

#endif

}  // namespace ulpgate
