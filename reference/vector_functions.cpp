// libmvec is looked up when it is first wanted: nothing is linked to it, and a machine without it does
// without.
#include "reference/vector_functions.hpp"

#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__)
#define ULPGATE_LIBMVEC
#include <dlfcn.h>
#include <immintrin.h>

#include <array>
#include <cstring>
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

// The last few points are filled up with ones.
template <FunctionId Id>
__attribute__((target("avx512f"))) void by_eight(const double* args, double* results, std::size_t count) {
  const Eight f = eight<Id>();
  std::size_t i = 0;
  for (; i + 8 <= count; i += 8) _mm512_storeu_pd(results + i, f(_mm512_loadu_pd(args + i)));
  if (i == count) return;
  std::array<double, 8> rest = {1, 1, 1, 1, 1, 1, 1, 1};
  std::memcpy(rest.data(), args + i, (count - i) * sizeof(double));
  _mm512_storeu_pd(rest.data(), f(_mm512_loadu_pd(rest.data())));
  std::memcpy(results + i, rest.data(), (count - i) * sizeof(double));
}

template <FunctionId Id>
__attribute__((target("avx2"))) void by_four(const double* args, double* results, std::size_t count) {
  const Four f = four<Id>();
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) _mm256_storeu_pd(results + i, f(_mm256_loadu_pd(args + i)));
  if (i == count) return;
  std::array<double, 4> rest = {1, 1, 1, 1};
  std::memcpy(rest.data(), args + i, (count - i) * sizeof(double));
  _mm256_storeu_pd(rest.data(), f(_mm256_loadu_pd(rest.data())));
  std::memcpy(results + i, rest.data(), (count - i) * sizeof(double));
}

template <FunctionId Id>
VectorFunction best() {
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      eight<Id>() != nullptr)
    return by_eight<Id>;
  if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 && four<Id>() != nullptr)
    return by_four<Id>;
  return nullptr;
}

}  // namespace

VectorFunction vector_function(FunctionId id) {
  switch (id) {
#define REAL1(name, d0, hard, oracle) \
  case FunctionId::name:              \
    return best<FunctionId::name>();
#include "reference/functions.def"
    default:
      return nullptr;
  }
}

#else

VectorFunction vector_function(FunctionId) {
  return nullptr;
}

#endif

}  // namespace ulpgate
