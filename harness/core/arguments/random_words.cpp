// First words of many Philox blocks.
#include "harness/core/arguments/random_words.hpp"

#include <cstddef>

namespace ulpgate::detail {

namespace {

constexpr std::size_t rounds = 10;
struct Product {
  std::uint64_t high;
  std::uint64_t low;
};
[[gnu::always_inline]] inline Product product(std::uint64_t a, std::uint64_t b) {
  const auto p = static_cast<unsigned __int128>(a) * b;
  return {static_cast<std::uint64_t>(p >> 64U), static_cast<std::uint64_t>(p)};
}

}  // namespace

// BMI2 has a multiplication that leaves its operands where they are: a sixth less.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
[[gnu::target_clones("default", "bmi2")]]
#endif
void philox_first_words(std::array<std::uint64_t, 2> key, std::uint64_t k, std::uint64_t argument,
                        std::span<std::uint64_t> words) {
  std::array<std::array<std::uint64_t, 2>, rounds> keys;
  keys[0] = key;
  for (std::size_t r = 1; r < rounds; ++r)
    keys[r] = {keys[r - 1][0] + PHILOX_W64_0, keys[r - 1][1] + PHILOX_W64_1};
  // Of the counter's two zeros the first round makes one more, and a number that all points share.
  const Product shared = product(PHILOX_M4x64_0, argument ^ keys[0][0]);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const Product first = product(PHILOX_M4x64_0, k + i);
    Product b = product(PHILOX_M4x64_1, first.high ^ keys[0][1]);
    std::uint64_t c0 = b.high ^ keys[1][0];
    std::uint64_t c1 = b.low;
    std::uint64_t c2 = shared.high ^ first.low ^ keys[1][1];
    std::uint64_t c3 = shared.low;
#pragma GCC unroll 8
    for (std::size_t r = 2; r + 1 < rounds; ++r) {
      const Product a = product(PHILOX_M4x64_0, c0);
      b = product(PHILOX_M4x64_1, c2);
      c0 = b.high ^ c1 ^ keys[r][0];
      c1 = b.low;
      c2 = a.high ^ c3 ^ keys[r][1];
      c3 = a.low;
    }
    words[i] = product(PHILOX_M4x64_1, c2).high ^ c1 ^ keys[rounds - 1][0];
  }
}

}  // namespace ulpgate::detail
