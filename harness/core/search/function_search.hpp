// FunctionSearch: a hunt for the largest error of one function in one type, behind one narrow interface.
#pragma once

#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "harness/core/subject/subject.hpp"
#include "reference/types/mpfr_value.hpp"
#include "reference/ulp/ulp.hpp"

namespace ulpgate {

// The largest error so far, proven with MPFR at the precision of RealHP<4>.
struct SearchBest {
  std::vector<MpfrValue> args;  // empty where nothing was judged yet
  double error_ulp = -1;
  double distance = 0;            // float_distance to the correctly rounded value
  std::uint64_t evaluations = 0;  // of the function, when it was found
};
struct SearchMismatch {
  std::vector<MpfrValue> args;  // of the first
  std::uint64_t confirmed = 0;  // how many were looked at, not how many there are
};

// See Search for rounds and batches.  What is found depends on the seed and the evaluations alone.
class FunctionSearch {
 public:
  FunctionSearch() = default;
  FunctionSearch(const FunctionSearch&) = delete;
  FunctionSearch& operator=(const FunctionSearch&) = delete;
  virtual ~FunctionSearch() = default;

  // Prepares a round of at most `most` evaluations and returns the number of its batches.
  virtual std::size_t begin_round(std::uint64_t most) = 0;
  // Any thread, each batch once.
  virtual void run_batch(std::size_t batch) = 0;
  virtual void end_round() = 0;

  [[nodiscard]] virtual std::uint64_t evaluations() const = 0;
  [[nodiscard]] virtual double best_error_ulp() const = 0;  // -1: none yet
  [[nodiscard]] virtual SearchBest best() const = 0;
  [[nodiscard]] virtual std::map<Outcome, SearchMismatch> mismatches() const = 0;
};

// Real and complex functions; special functions have integer arguments and are not searched.
[[nodiscard]] bool can_search(const Subject& subject);
// can_search(subject) must hold.
[[nodiscard]] std::unique_ptr<FunctionSearch> make_search(const Subject& subject, std::uint64_t seed);
// A search that passes over the neighbourhoods of known points, so that the large errors there hide no
// smaller ones elsewhere.
[[nodiscard]] std::unique_ptr<FunctionSearch> make_search_elsewhere(const Subject& subject,
                                                                    std::uint64_t seed,
                                                                    const ArgumentList& known);

}  // namespace ulpgate
