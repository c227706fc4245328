// Arguments of a kernel.
#include "harness/interface/kernel_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::kernel_test {

namespace {

struct Type {
  int digits;
  int least_exponent;  // of the smallest positive number
  long double (*rounded)(long double);
};

Type type_of(const std::string& name) {
  if (name == "float") {
    return {std::numeric_limits<float>::digits, -149,
            [](long double x) { return static_cast<long double>(static_cast<float>(x)); }};
  }
  if (name == "double") {
    return {std::numeric_limits<double>::digits, -1074,
            [](long double x) { return static_cast<long double>(static_cast<double>(x)); }};
  }
  using L = std::numeric_limits<long double>;
  return {L::digits, L::min_exponent - L::digits, [](long double x) { return x; }};
}

class Maker {
 public:
  Maker(const ulpgate_kernel& kernel, std::uint64_t seed)
      : kernel_(kernel),
        type_(type_of(kernel.type)),
        stream_(seed ^ fnv1a(kernel.name)),
        arguments_(static_cast<std::size_t>(kernel.arguments)) {}

  std::vector<Points> make(std::uint64_t samples, bool extremes) {
    std::vector<Points> all;
    const auto draw = [&](const char* name, auto&& one) {
      Points p{name, {}};
      for (std::uint64_t i = 0; i < samples; ++i)
        for (std::size_t j = 0; j < arguments_; ++j) p.values.push_back(one(j, p.values.size() - j));
      all.push_back(std::move(p));
    };
    draw("uniform", [&](std::size_t j, std::size_t) {
      const long double low = kernel_.low[j];
      return kept(j, low + (static_cast<long double>(kernel_.high[j]) - low) * stream_.share());
    });
    draw("spread", [&](std::size_t j, std::size_t) { return spread(j); });
    if (arguments_ > 1) {
      std::vector<long double> first;
      draw("near", [&](std::size_t j, std::size_t) {
        if (j == 0) near_ = spread(0);
        return j == 0 ? near_ : near(j);
      });
    }
    all.push_back({"edges", combined([&](std::size_t j) { return edge_values(j); })});
    if (extremes) all.push_back({"extremes", combined([&](std::size_t j) { return extreme_values(j); })});
    return all;
  }

 private:
  [[nodiscard]] long double kept(std::size_t j, long double x) const {
    const long double rounded = type_.rounded(x);
    return std::clamp(rounded, inward(kernel_.low[j], 1), inward(kernel_.high[j], -1));
  }
  // The end of a range as a number of the type that does not lie outside.
  [[nodiscard]] long double inward(double end, int towards) const {
    const long double x = type_.rounded(end);
    const bool outside = towards > 0 ? x < end : x > end;
    return outside ? neighbour(x, towards) : x;
  }
  [[nodiscard]] long double neighbour(long double x, int towards) const {
    const long double to = towards > 0 ? HUGE_VALL : -HUGE_VALL;
    if (type_.digits == std::numeric_limits<float>::digits)
      return std::nextafter(static_cast<float>(x), static_cast<float>(to));
    if (type_.digits == std::numeric_limits<double>::digits)
      return std::nextafter(static_cast<double>(x), static_cast<double>(to));
    return std::nextafter(x, to);
  }

  [[nodiscard]] long double spread(std::size_t j) {
    const long double low = kernel_.low[j];
    const long double high = kernel_.high[j];
    const bool negative = high <= 0 || (low < 0 && (stream_.word() & 1U) != 0);
    const long double most = negative ? -low : high;
    const long double least = negative ? std::max(0.0L, -high) : std::max(0.0L, low);
    if (!(most > 0)) return kept(j, low);
    const int top = std::ilogb(most);
    // Down to 2^-40 of the largest where the range holds zero: below that all is the same to most kernels,
    // and edges have it.
    const int bottom = least > 0 ? std::ilogb(least) : std::max(type_.least_exponent, top - 40);
    const int exponent =
        bottom + static_cast<int>(stream_.word() % static_cast<std::uint64_t>(top - bottom + 1));
    const long double size = std::ldexp(1 + stream_.share(), exponent);
    return kept(j, negative ? -size : size);
  }

  [[nodiscard]] long double near(std::size_t j) {
    const std::uint64_t word = stream_.word();
    // From next to it up to a share of 2^-3.
    const int exponent = -3 - static_cast<int>(word % static_cast<std::uint64_t>(type_.digits - 3));
    const long double x = near_ * (1 + std::ldexp(stream_.share(), exponent));
    return kept(j, (word >> 32U & 1U) != 0 ? -x : x);
  }

  [[nodiscard]] std::vector<long double> edge_values(std::size_t j) const {
    const long double low = inward(kernel_.low[j], 1);
    const long double high = inward(kernel_.high[j], -1);
    std::vector<long double> all = {low, neighbour(low, 1), high, neighbour(high, -1)};
    for (const long double x : {0.0L, -0.0L, 1.0L, -1.0L, neighbour(1, 1), neighbour(1, -1), 0.5L, 2.0L}) {
      if (x >= low && x <= high) all.push_back(x);
    }
    return all;
  }

  [[nodiscard]] std::vector<long double> extreme_values(std::size_t j) const {
    const long double low = inward(kernel_.low[j], 1);
    const long double high = inward(kernel_.high[j], -1);
    const long double tiny = std::ldexp(1.0L, type_.least_exponent);
    const long double normal = std::ldexp(1.0L, type_.least_exponent + type_.digits - 1);
    std::vector<long double> all = {low, high};
    for (const long double size : {0.0L, tiny, 3 * tiny, normal - tiny, normal, std::sqrt(normal), 1.0L}) {
      for (const long double x : {type_.rounded(size), -type_.rounded(size)})
        if (x >= low && x <= high) all.push_back(x);
    }
    return all;
  }

  // Every pair of values of the first two arguments with each value of the others in turn.
  template <class ValuesOf>
  [[nodiscard]] std::vector<long double> combined(ValuesOf values_of) const {
    std::vector<std::vector<long double>> lists;
    for (std::size_t j = 0; j < arguments_; ++j) lists.push_back(values_of(j));
    std::vector<long double> values;
    const std::size_t second = arguments_ > 1 ? lists[1].size() : 1;
    for (std::size_t a = 0; a < lists[0].size(); ++a) {
      for (std::size_t b = 0; b < second; ++b) {
        for (std::size_t j = 0; j < arguments_; ++j) {
          const std::size_t which = j == 0 ? a : j == 1 ? b : (a + b * j) % lists[j].size();
          values.push_back(lists[j][which]);
        }
      }
    }
    return values;
  }

  const ulpgate_kernel& kernel_;
  Type type_;
  SplitMix64 stream_;
  std::size_t arguments_;
  long double near_ = 0;
};

}  // namespace

std::vector<Points> points_of(const ulpgate_kernel& kernel, std::uint64_t samples, std::uint64_t seed,
                              bool extremes) {
  return Maker(kernel, seed).make(samples, extremes);
}

}  // namespace ulpgate::kernel_test
