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

namespace detail {

void philox_first_words(std::array<std::uint64_t, 2> key, std::uint64_t k, std::uint64_t argument,
                        std::span<std::uint64_t> words);

// The double nearest to 200 f - 100, f = 0.w in base 2^64, of each word w.
void on_minus_100_100(std::span<const std::uint64_t> words, double* out);

}  // namespace detail

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
    detail::philox_first_words({key_[0], key_[1]}, k, argument, words);
  }

 private:
  r123::Philox4x64::key_type key_;
};

}  // namespace ulpgate
