// The space that a search walks through: positions of arguments as integers, points, boxes, random numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstdint>
#include <vector>

#include "reference/functions/function_info.hpp"

namespace ulpgate {

// A position is the signed rank of a number among the values of its type, zero being 0: neighbouring numbers
// have neighbouring positions, and a binade is an interval of 2^(p-1) of them.  Types of up to 128 bits use
// __int128, wider ones an integer of fixed size.
template <unsigned Bits>
using WidePosition = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<Bits, Bits, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;

template <class Position>
struct WidthOf {
  using type = Position;
};
template <>
struct WidthOf<__int128> {
  // The distance of two positions of binary128 needs 128 bits.
  using type = unsigned __int128;
};
template <class Position>
using Width = typename WidthOf<Position>::type;

template <class Position>
[[nodiscard]] Width<Position> width_of(const Position& low, const Position& high) {
  return static_cast<Width<Position>>(high) - static_cast<Width<Position>>(low);
}
template <class Position>
[[nodiscard]] Position moved(const Position& x, const Width<Position>& by) {
  return static_cast<Position>(static_cast<Width<Position>>(x) + by);
}
// Moves within [low, high]; what would lie beyond an end is cut to it.
template <class Position>
[[nodiscard]] Position moved_within(const Position& x, const Width<Position>& by, bool up,
                                    const Position& low, const Position& high) {
  const Width<Position> room = up ? width_of(x, high) : width_of(low, x);
  if (by >= room) return up ? high : low;
  return up ? moved(x, by) : static_cast<Position>(static_cast<Width<Position>>(x) - by);
}

template <class Integer>
[[nodiscard]] int bit_length(Integer w) {
  if constexpr (requires { msb(w); }) {
    return w == 0 ? 0 : static_cast<int>(msb(w)) + 1;
  } else {
    const auto high = static_cast<std::uint64_t>(w >> 64);
    const int low_bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(w)));
    return high != 0 ? 64 + static_cast<int>(std::bit_width(high)) : low_bits;
  }
}

// A stream of random words that a key opens (SplitMix64; Steele, Lea, Flood, OOPSLA 2014).
class SearchRandom {
 public:
  explicit SearchRandom(std::uint64_t key) : state_(key) {}

  std::uint64_t word() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>((static_cast<unsigned __int128>(word()) * n) >> 64U);
  }
  // From 0 to `greatest`, nearly evenly: the upper part of a range that is no power of two comes up less.
  template <class W>
  W up_to(const W& greatest) {
    if constexpr (std::same_as<W, unsigned __int128>) {
      if (greatest < ~std::uint64_t{0}) return below(static_cast<std::uint64_t>(greatest) + 1);
    }
    const int bits = bit_length(greatest);
    W r = 0;
    for (int i = 0; i < bits; i += 64) r = (r << 64) | W(word());
    r &= (W(1) << (bits - 1)) - 1 + (W(1) << (bits - 1));
    return r > greatest ? r - greatest : r;
  }

 private:
  std::uint64_t state_;
};

template <class Position>
using SearchPoint = std::array<Position, max_arity>;

// A product of closed intervals of positions, with the largest error seen in it.
template <class Position>
struct SearchBox {
  SearchPoint<Position> low{};
  SearchPoint<Position> high{};
  double error = -1;
  SearchPoint<Position> best{};  // where that error was seen

  [[nodiscard]] bool contains(const SearchPoint<Position>& x, std::size_t arity) const {
    for (std::size_t i = 0; i < arity; ++i)
      if (x[i] < low[i] || x[i] > high[i]) return false;
    return true;
  }
  [[nodiscard]] std::size_t widest(std::size_t arity) const {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < arity; ++i)
      if (width_of(low[i], high[i]) > width_of(low[widest], high[widest])) widest = i;
    return widest;
  }
  [[nodiscard]] SearchPoint<Position> draw(SearchRandom& random, std::size_t arity) const {
    SearchPoint<Position> x{};
    for (std::size_t i = 0; i < arity; ++i)
      x[i] = moved(low[i], random.up_to(Width<Position>(width_of(low[i], high[i]))));
    return x;
  }
  // A position of argument `slot` at most 2^scale from x.
  [[nodiscard]] Position near(const Position& x, int scale, std::size_t slot, SearchRandom& random) const {
    const Width<Position> by = random.up_to(Width<Position>(Width<Position>(1) << scale));
    return moved_within(x, by, (random.word() & 1U) != 0, low[slot], high[slot]);
  }
  // Cuts argument `slot` into `parts` of equal width; what is narrower than that stays whole.  The child that
  // holds the best point inherits it.
  void split(std::size_t slot, unsigned parts, std::size_t arity, std::vector<SearchBox>& out) const {
    const Width<Position> width = width_of(low[slot], high[slot]);
    const Width<Position> step = width / parts;
    if (step == 0) parts = 1;
    for (unsigned i = 0; i < parts; ++i) {
      SearchBox child = *this;
      if (i > 0) child.low[slot] = moved(low[slot], Width<Position>(step * i + 1));
      if (i + 1 < parts) child.high[slot] = moved(low[slot], Width<Position>(step * (i + 1)));
      if (!child.contains(best, arity)) child.error = -1;
      out.push_back(std::move(child));
    }
  }
};

}  // namespace ulpgate
