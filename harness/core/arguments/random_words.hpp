// Counter-based random words: word = f(seed, function, stratum, k, argument, block), with no state to carry.
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace ulpgate {

// FNV-1a, 64 bits (Fowler, Noll, Vo); names streams and plans.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::string_view text,
                                            std::uint64_t hash = 0xcbf29ce484222325ULL) {
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

// A stream of words from a seed, for samples that nobody records by their index (Steele, Lea, Flood: "Fast
// splittable pseudorandom number generators", 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t word() {
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  // Of [0, 1), with all 64 bits.
  long double share() { return static_cast<long double>(word()) * 0x1p-64L; }

 private:
  std::uint64_t state_;
};

// One stream per (seed, function, stratum).  Philox4x64-10: Salmon et al., "Parallel random numbers: as easy
// as 1, 2, 3", SC'11.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view function, std::string_view stratum)
      : key_{{seed, fnv1a(stratum, fnv1a(function))}} {}

  // Fills `words` with the words of argument `argument` of point k.
  void fill(std::uint64_t k, std::uint64_t argument, std::span<std::uint64_t> words) const {
    r123::Philox4x64 generator;
    for (std::size_t i = 0; i < words.size(); i += 4) {
      const r123::Philox4x64::ctr_type counter{{k, argument, i / 4, 0}};
      const auto block = generator(counter, key_);
      for (std::size_t j = 0; j < 4 && i + j < words.size(); ++j) words[i + j] = block[j];
    }
  }

  // The first word of each of the points from k on, words.size() of them: the same rounds without what other
  // words need alone.
  void first_words(std::uint64_t k, std::uint64_t argument, std::span<std::uint64_t> words) const {
    std::array<std::array<std::uint64_t, 2>, rounds> keys;
    keys[0] = {key_[0], key_[1]};
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

 private:
  static constexpr std::size_t rounds = 10;
  struct Product {
    std::uint64_t high;
    std::uint64_t low;
  };
  static Product product(std::uint64_t a, std::uint64_t b) {
    const auto p = static_cast<unsigned __int128>(a) * b;
    return {static_cast<std::uint64_t>(p >> 64U), static_cast<std::uint64_t>(p)};
  }

  r123::Philox4x64::key_type key_;
};

}  // namespace ulpgate
