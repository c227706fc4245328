// The order in which subjects are timed: another one in each round.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ulpgate {

// 0 ... count-1 shuffled, the same for the same round: subjects timed in one fixed order would share what
// the machine does in between (J. H. Curtsinger, E. D. Berger: Stabilizer, ASPLOS 2013; random interleaving
// of benchmark libraries).
[[nodiscard]] std::vector<std::size_t> interleaved_order(std::size_t count, std::uint64_t round);

}  // namespace ulpgate
