// Digests of results.
#include "harness/core/gate/digest.hpp"

#include <fmt/format.h>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate {

bool has_portable_results(std::string_view type) {
  return type != "long_double" && !type.starts_with("cpp_bin_float");
}

std::string results_digest(const RowRecord& r) {
  const Summary& s = r.summary;
  std::string text = fmt::format("{} {} {} {} {}", s.samples, s.correctly_rounded, s.max_error.index,
                                 s.histogram.exact, s.sum.to_text());
  for (std::size_t o = 0; o < outcome_count; ++o) {
    // Those of foreign functions alone came later: where there are none, digests are what they were.
    if (s.outcomes[o] > 0 || o <= static_cast<std::size_t>(Outcome::exception))
      text += fmt::format(" {}", s.outcomes[o]);
  }
  for (const auto& [bucket, n] : s.histogram.counts) text += fmt::format(" {}:{}", bucket, n);
  const std::uint64_t hash = fnv1a(text);
  return fmt::format("{:08x}", (hash ^ (hash >> 32U)) & 0xffffffffU);
}

}  // namespace ulpgate
