// First words of many Philox blocks, for several instruction sets.
#include "harness/core/arguments/random_words.hpp"

#include <cstddef>

#include "reference/lanes/levels.hpp"

namespace ulpgate::detail {

namespace {

constexpr std::size_t philox_rounds = 10;

template <class Word>
struct Product {
  Word high;
  Word low;
};
ULPGATE_INLINE Product<std::uint64_t> product_of(std::uint64_t a, std::uint64_t b) {
  const auto p = static_cast<unsigned __int128>(a) * b;
  return {static_cast<std::uint64_t>(p >> 64U), static_cast<std::uint64_t>(p)};
}

template <class Word>
struct Counter {
  Word c0, c1, c2, c3;
};

// What the blocks of an argument share: keys, and of the counter's two zeros what the first round makes of
// them.
struct Philox {
  std::array<std::array<std::uint64_t, 2>, philox_rounds> keys;
  Product<std::uint64_t> shared;
};

#define ULPGATE_LEVEL_FILE "harness/core/arguments/random_words.inc"
#include "reference/lanes/each_level.inc"

struct Kernels {
  void (*first_words)(const Philox&, std::uint64_t, std::uint64_t*, std::size_t);
  void (*values)(const std::uint64_t*, double*, std::size_t);
};

Kernels best_kernels() {
#ifdef ULPGATE_LEVELS
  const std::size_t levels = instruction_levels();
  if (levels > 2) return {avx512::first_words, avx512::values_on_minus_100_100};
  if (levels > 1) return {avx2::first_words, avx2::values_on_minus_100_100};
#endif
  return {baseline::first_words, baseline::values_on_minus_100_100};
}

const Kernels& kernels() {
  static const Kernels best = best_kernels();
  return best;
}

}  // namespace

void philox_first_words(std::array<std::uint64_t, 2> key, std::uint64_t k, std::uint64_t argument,
                        std::span<std::uint64_t> words) {
  Philox p;
  p.keys[0] = key;
  for (std::size_t r = 1; r < philox_rounds; ++r)
    p.keys[r] = {p.keys[r - 1][0] + PHILOX_W64_0, p.keys[r - 1][1] + PHILOX_W64_1};
  p.shared = product_of(PHILOX_M4x64_0, argument ^ key[0]);
  kernels().first_words(p, k, words.data(), words.size());
}

void on_minus_100_100(std::span<const std::uint64_t> words, double* out) {
  kernels().values(words.data(), out, words.size());
}

}  // namespace ulpgate::detail
