// Summary: what a run keeps of the judged samples of one row; merging is exact and independent of order.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>

#include "reference/ulp/ulp.hpp"

namespace ulpgate {

inline constexpr std::uint64_t no_index = std::numeric_limits<std::uint64_t>::max();

// Buckets of the ULP error, named by their upper edge 2^(i/4): quarter octaves above 1/4 ULP, octaves below,
// where a cheap reference could not tell quarters apart and nobody asks.
class UlpHistogram {
 public:
  static constexpr int least = -24;          // everything up to 2^-6
  static constexpr int finest = -8;          // from this bucket down each holds an octave
  static constexpr int greatest = 4 * 1024;  // everything above 2^1023.75, infinity included

  void add(Ulp error);
  void merge(const UlpHistogram& other);
  // Upper edge of the first bucket at which at least `fraction` of the samples are reached; 0 for exact
  // results. NaN when empty.
  [[nodiscard]] double quantile(double fraction) const;
  // Of a nonzero error.
  [[nodiscard]] static int bucket(Ulp error);
  // Bucket i holds errors in (lower_edge(i), upper_edge(i)].
  [[nodiscard]] static double upper_edge(int bucket);
  [[nodiscard]] static double lower_edge(int bucket);

  std::uint64_t exact = 0;
  std::map<int, std::uint64_t> counts;
};

// Where in its bucket the error of sample k is rounded up to the upper edge rather than down to the lower
// one: uniform between the edges, from the counter k alone.  The expectation of the rounded error is the
// error, so the mean of many is right to a twentieth of an ULP over the root of their number where errors are
// below 1/2, and a reference need only prove on which side of the threshold an error lies.  The least bucket
// is rounded up always.
[[nodiscard]] double rounding_threshold(int bucket, std::uint64_t k);

// A number of [0, 1) from a counter: SplitMix64's finalizer (Steele, Lea, Flood: "Fast splittable
// pseudorandom number generators", 2014).
[[nodiscard]] inline double counter_fraction(std::uint64_t k) {
  std::uint64_t z = k + 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  z ^= z >> 31U;
  return static_cast<double>(z >> 11U) * 0x1p-53;
}

// The sum of errors, each rounded to an edge of its bucket, as an integer over 2^-40 ULP, so that order does
// not matter.  One error counts at most 2^60 ULP: beyond that a mean says nothing, the maximum and the
// histogram do.
class UlpSum {
 public:
  void add(Ulp error, std::uint64_t k);
  void add_edges(double edge, std::uint64_t count);
  void merge(const UlpSum& other) { units_ += other.units_; }
  [[nodiscard]] double mean(std::uint64_t count) const;
  [[nodiscard]] std::string to_text() const;  // hexadecimal
  [[nodiscard]] static UlpSum from_text(std::string_view hex);

 private:
  unsigned __int128 units_ = 0;
};

// A maximum with the lowest index that reaches it.
struct Maximum {
  double value = -1;  // nothing seen yet
  std::uint64_t index = no_index;

  void add(double v, std::uint64_t k) {
    if (v > value || (v == value && k < index)) {
      value = v;
      index = k;
    }
  }
  void merge(const Maximum& other) {
    if (other.index != no_index) add(other.value, other.index);
  }
};

// Comparison of the two oracles on the sub-sample: the family's RealHP<4> against MPFR, in ULP of Real.
struct OracleComparison {
  std::uint64_t compared = 0;
  std::uint64_t disagreed = 0;
  Maximum difference;

  void merge(const OracleComparison& other) {
    compared += other.compared;
    disagreed += other.disagreed;
    difference.merge(other.difference);
  }
};

struct Summary {
  std::uint64_t samples = 0;
  std::uint64_t correctly_rounded = 0;
  std::array<std::uint64_t, outcome_count> outcomes{};
  std::array<std::uint64_t, outcome_count> first_index;  // lowest index per outcome
  Maximum max_error;
  double max_distance = -1;
  // Largest error / max(1, condition number), over results that are off by more than half a ULP; 0 if none
  // is.
  double max_error_over_condition = 0;
  Maximum normwise;  // of a kernel's quantity: |got - exact| / |exact| in units of 2^-p
  UlpHistogram histogram;
  UlpSum sum;
  OracleComparison oracle;

  Summary() { first_index.fill(no_index); }
  void add(const Judgement& judgement, std::uint64_t k);
  void merge(const Summary& other);
  [[nodiscard]] std::uint64_t judged() const { return outcomes[static_cast<std::size_t>(Outcome::finite)]; }
  [[nodiscard]] std::uint64_t mismatches() const { return samples - judged(); }
};

}  // namespace ulpgate
