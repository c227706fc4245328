// The order of a round.
#include "harness/core/trend/interleaved_order.hpp"

#include <array>
#include <numeric>
#include <utility>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate {

std::vector<std::size_t> interleaved_order(std::size_t count, std::uint64_t round) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const RandomStream stream(1, "work_precision", "interleaving");
  // Fisher and Yates; the bias of a modulus of 64 bits shows to nobody.
  for (std::size_t i = count; i > 1; --i) {
    std::array<std::uint64_t, 1> word{};
    stream.fill(round, i, word);
    std::swap(order[i - 1], order[word[0] % i]);
  }
  return order;
}

}  // namespace ulpgate
