// Counter-based random words: word = f(seed, function, stratum, k, argument, block), with no state to carry.
#pragma once

#include <Random123/philox.h>

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

 private:
  r123::Philox4x64::key_type key_;
};

}  // namespace ulpgate
