// Fingerprints of searches: the same seed and the same number of evaluations try the same points and end with
// the same find, on every machine.
//
// The targets are made of integers and of sums that are exact, and no C library has a say in them.  A change
// of a number below changes what every search with a fixed number of evaluations finds: that is a decision,
// to be told with the change, and never a repair of this test.
#include <gtest/gtest.h>

#include "harness/core/search/search.hpp"
#include "harness/core/testing/fingerprint.hpp"

namespace ulpgate {
namespace {

using testing::Fingerprint;
using testing::literal;
using Point = SearchPoint<__int128>;

// 16 random bits of a point.
std::uint64_t noise(const Point& x, std::size_t arity) {
  std::uint64_t words = 0;
  for (std::size_t i = 0; i < arity; ++i)
    words = SearchRandom(words ^ static_cast<std::uint64_t>(x[i])).word();
  return words >> 48U;
}

int bits_apart(__int128 a, __int128 b) {
  return bit_length(static_cast<unsigned __int128>(a < b ? b - a : a - b));
}

// Errors are multiples of 2^-24 below 2^8: sums of thousands of them are exact in any order.
struct Shape {
  std::string_view name;
  std::size_t arity;
  int domain_bits;  // of either side of zero
  int cheap_scale;
  int significand_bits;
  double (*error)(const Point& x);
  bool (*is_mismatch)(const Point& x);
  bool (*is_known)(const Point& x);
  double estimate;  // of an error of 1
};

bool never(const Point&) {
  return false;
}

constexpr __int128 top = (__int128{1} << 55) + 123456789;

double narrow_peak(const Point& x) {
  const int most = 52 - bits_apart(x[0], top);
  return static_cast<double>(noise(x, 1)) * 0x1p-17 + (most > 0 ? most * 0.125 : 0);
}

// A ridge in each argument; where they cross they add up.
double two_ridges(const Point& x) {
  const int first = 58 - bits_apart(x[0], top);
  const int second = 58 - bits_apart(x[1], -top);
  return static_cast<double>(noise(x, 2)) * 0x1p-17 + (first > 0 ? first * 0.0625 : 0) +
         (second > 0 ? second * 0.0625 : 0);
}
bool one_in_64(const Point& x) {
  return x[0] % 64 == 7;
}

// Noise whose amplitude rises to an edge and falls there by half.
double amplitude(const Point& x) {
  constexpr __int128 edge = __int128{1} << 39;
  const auto steps = static_cast<double>(x[0] < 0 || x[0] > edge ? 128 : 192 + static_cast<int>(x[0] >> 33));
  return steps * static_cast<double>(noise(x, 1)) * 0x1p-24;
}

// What is known is large, and what hides behind it is small.
bool near_the_known(const Point& x) {
  return bits_apart(x[0], -top) <= 46;
}
double hidden(const Point& x) {
  return near_the_known(x) ? 100 : narrow_peak(x);
}

// Two arguments of 118 bits: the widths of positions beyond a word.
double wide_ridge(const Point& x) {
  const int most = 116 - bits_apart(x[0] + x[1], top);
  return static_cast<double>(noise(x, 2)) * 0x1p-17 + (most > 0 ? most * 0.0625 : 0);
}

constexpr Shape shapes[] = {
    {"narrow peak", 1, 62, 62, 53, narrow_peak, never, never, 1 + 0x1p-9},
    {"cheap neighbours", 1, 62, 20, 53, narrow_peak, never, never, 1 + 0x1p-9},
    {"two ridges", 2, 62, 62, 53, two_ridges, one_in_64, never, 1},
    {"amplitude", 1, 40, 20, 24, amplitude, one_in_64, never, 1},
    {"hidden", 1, 62, 38, 53, hidden, never, near_the_known, 1},
    {"wide ridge", 2, 118, 98, 113, wide_ridge, never, never, 1},
    // Estimates that are off by a hundredth are good where errors are large, those off by a quarter are lies.
    {"estimates by the hundredth", 1, 62, 62, 53, narrow_peak, never, never, 1.01171875},
    {"lies by a quarter", 1, 40, 20, 24, amplitude, never, never, 1.25},
};

class ShapedTarget final : public SearchTarget<__int128> {
 public:
  explicit ShapedTarget(const Shape& shape) : shape_(shape) {}
  std::size_t arity() const override { return shape_.arity; }
  SearchBox<__int128> domain() const override {
    SearchBox<__int128> box;
    for (std::size_t i = 0; i < arity(); ++i) {
      box.low[i] = -(__int128{1} << shape_.domain_bits);
      box.high[i] = __int128{1} << shape_.domain_bits;
    }
    return box;
  }
  // Called from one thread here.
  void rank(std::span<const Point> points, std::span<double> errors) const override {
    for (std::size_t i = 0; i < points.size(); ++i) {
      see(points[i]);
      errors[i] = shape_.is_mismatch(points[i])
                      ? std::numeric_limits<double>::infinity()
                      : shape_.error(points[i]) * (distrusted_at < 0 ? shape_.estimate : 1);
    }
    tried_ += points.size();
  }
  Judgement confirm(const Point& x) const override {
    see(x);
    if (shape_.is_mismatch(x)) return {Outcome::nan, {}, 0, false};
    return {Outcome::finite, {shape_.error(x)}, 1, false};
  }
  bool is_known(const Point& x) const override { return shape_.is_known(x); }
  int cheap_scale() const override { return shape_.cheap_scale; }
  int significand_bits() const override { return shape_.significand_bits; }
  void distrust_estimates() override { distrusted_at = static_cast<std::int64_t>(tried_); }

  std::uint64_t seen() const { return seen_.value(); }
  std::int64_t distrusted_at = -1;  // evaluations

 private:
  void see(const Point& x) const {
    for (std::size_t i = 0; i < arity(); ++i) seen_.add_position(x[i]);
  }

  const Shape& shape_;
  mutable Fingerprint seen_;
  mutable std::uint64_t tried_ = 0;
};

struct Result {
  std::string_view name;
  std::uint64_t evaluations;  // when the best was found
  std::uint64_t at;           // of all its arguments
  double error;
  std::uint64_t mismatches;  // confirmed
  std::int64_t distrusted_at;
  std::uint64_t seen;  // all points that were ranked or confirmed, in their order
};

// 50 rounds of 2^13, two of them cut short, and a seed of either side.
Result searched(const Shape& shape) {
  ShapedTarget target(shape);
  SearchBox<__int128> ordinary = target.domain();
  for (std::size_t i = 0; i < shape.arity; ++i) ordinary.low[i] = top / 2;
  for (std::size_t i = 0; i < shape.arity; ++i) ordinary.high[i] = std::min(2 * top, ordinary.high[i]);
  if (!(ordinary.low[0] < ordinary.high[0])) ordinary = target.domain();
  const std::vector<Point> seeds = {{-12345, 5}, {0, 0}, {1 << 20, 77}};
  Search<__int128> search(target, {target.domain(), ordinary}, seeds, 11, {1U << 13U});
  constexpr std::uint64_t evaluations = 50 * (1U << 13U) + 777;
  while (search.evaluations() < evaluations) {
    const std::uint64_t left = evaluations - search.evaluations();
    const std::size_t n = search.begin_round(std::min<std::uint64_t>(left, left > 200000 ? left : 20000));
    for (std::size_t i = 0; i < n; ++i) search.run_batch(i);
    search.end_round();
  }
  EXPECT_EQ(search.evaluations(), evaluations) << shape.name;
  Fingerprint at;
  for (std::size_t i = 0; i < shape.arity; ++i) at.add_position(search.best().at[i]);
  std::uint64_t mismatches = 0;
  for (const auto& [outcome, m] : search.mismatches()) mismatches += m.confirmed;
  return {shape.name, search.best().evaluations, at.value(),   search.best().error,
          mismatches, target.distrusted_at,      target.seen()};
}

constexpr Result results[] = {
    {"narrow peak", 177027, 0x68586644269f93d6, 0x1.b3f4ep+2, 0, -1, 0x8ae35c175066efaa},
    {"cheap neighbours", 205187, 0x68586644269f93d6, 0x1.b3f4ep+2, 0, -1, 0x096fed285f306d5f},
    {"two ridges", 410377, 0x76ee639bff5b0f63, 0x1.6e59p+2, 176, -1, 0x1a3796898dd17266},
    {"amplitude", 232195, 0x9c735f2d977af5cb, 0x1.fdfe02p-1, 176, -1, 0xd1672dc4852ed265},
    {"hidden", 195715, 0x68586644269f93d6, 0x1.b3f4ep+2, 0, -1, 0xbc0e1136bd590610},
    {"wide ridge", 272003, 0x33f33d35e1e26abb, 0x1.eb1a2p+2, 0, -1, 0x0070ea42a6fb9141},
    {"estimates by the hundredth", 129923, 0x68586644269f93d6, 0x1.b3f4ep+2, 0, -1, 0xa1b20f8cad580082},
    {"lies by a quarter", 173827, 0x475e2c7e92c8bf3c, 0x1.fdfe02p-1, 0, 35203, 0x4d617b4d787db93d},
};

TEST(SearchFingerprints, ASeedAndANumberOfEvaluationsTryTheSamePointsForEver) {
  ASSERT_EQ(std::size(results), std::size(shapes));
  for (std::size_t i = 0; i < std::size(shapes); ++i) {
    const Result& want = results[i];
    const Result now = searched(shapes[i]);
    char error[40];
    std::snprintf(error, sizeof error, "%a", now.error);
    EXPECT_TRUE(want.name == now.name && want.evaluations == now.evaluations && want.at == now.at &&
                want.error == now.error && want.mismatches == now.mismatches &&
                want.distrusted_at == now.distrusted_at && want.seen == now.seen)
        << "now {\"" << now.name << "\", " << now.evaluations << ", " << literal(now.at) << ", " << error
        << ", " << now.mismatches << ", " << now.distrusted_at << ", " << literal(now.seen) << "},";
  }
}

}  // namespace
}  // namespace ulpgate
