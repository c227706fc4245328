// The test of Mann and Whitney: whether one of two samples tends to be larger, whatever its distribution is.
#pragma once

#include <span>

namespace ulpgate {

struct RankSum {
  double u = 0;        // pairs in which the second is larger; a tie counts one half
  double p_value = 1;  // of both sides: how often samples of one distribution differ at least as much
  double shift = 0;    // Hodges and Lehmann's: the median of all differences, second less first
};

// H. B. Mann, D. R. Whitney: On a test of whether one of two random variables is stochastically larger than
// the other, Ann. Math. Stat. 18 (1947).  Exact where no two values are the same and the samples have at most
// 400 pairs; otherwise by the normal approximation with the correction for ties and for continuity.  A sample
// that is empty says nothing: p = 1.
[[nodiscard]] RankSum rank_sum(std::span<const double> first, std::span<const double> second);

// The smallest p that samples of these sizes can have: that of no overlap at all.
[[nodiscard]] double least_p_value(std::size_t first, std::size_t second);

}  // namespace ulpgate
