// Tests of summaries: exact sums, histograms, and that merging in any order gives the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "harness/core/records/summary_text.hpp"
#include "harness/core/stages/ordinary_errors.hpp"

namespace ulpgate {
namespace {

void expect_equal(const Summary& a, const Summary& b) {
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_EQ(a.outcomes, b.outcomes);
  EXPECT_EQ(a.first_index, b.first_index);
  EXPECT_EQ(a.max_error.value, b.max_error.value);
  EXPECT_EQ(a.max_error.index, b.max_error.index);
  EXPECT_EQ(a.max_distance, b.max_distance);
  EXPECT_EQ(a.histogram.counts, b.histogram.counts);
  EXPECT_EQ(a.sum.to_text(), b.sum.to_text());
  EXPECT_EQ(a.correctly_rounded, b.correctly_rounded);
}

TEST(Histogram, BucketsHoldTheirUpperEdge) {
  for (int i = UlpHistogram::least; i < 400; i += i < UlpHistogram::finest ? 4 : 1) {
    const int next = i + (i < UlpHistogram::finest ? 4 : 1);
    const double edge = UlpHistogram::upper_edge(i);
    EXPECT_EQ(UlpHistogram::bucket({edge}), i);
    EXPECT_EQ(UlpHistogram::bucket({std::nextafter(edge, HUGE_VAL)}), next);
    EXPECT_EQ(UlpHistogram::lower_edge(next), edge);
    EXPECT_NEAR(std::log2(edge), i / 4.0, 1e-14);
  }
  EXPECT_EQ(UlpHistogram::bucket({1e-300}), UlpHistogram::least);
  EXPECT_EQ(UlpHistogram::bucket({HUGE_VAL}), UlpHistogram::greatest);
}

TEST(OrdinaryErrors, AreTheHistogramsBucketsAndThresholds) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    const double error =
        i < 9 ? OrdinaryErrors::upper[static_cast<std::size_t>(i)]
              : std::ldexp(static_cast<double>(random() >> 11U), -54 - static_cast<int>(random() % 12));
    if (error == 0) continue;
    const std::size_t slot = OrdinaryErrors::slot(error);
    const int bucket = UlpHistogram::bucket({error});
    EXPECT_EQ(OrdinaryErrors::buckets[slot], bucket) << error;
    EXPECT_EQ(OrdinaryErrors::upper[slot], UlpHistogram::upper_edge(bucket));
    const std::uint64_t k = random();
    EXPECT_EQ(OrdinaryErrors::threshold(slot, k), rounding_threshold(bucket, k));
  }
}

TEST(OrdinaryErrors, CountAsASummaryDoes) {
  OrdinaryErrors ordinary;
  Summary want;
  Summary got;
  for (std::uint64_t k = 5; k < 5000; ++k) {
    const double error = std::ldexp(static_cast<double>(k), -14);
    want.add({Outcome::finite, {error}, 0, true}, k);
    got.max_error.add(error, k);
    if (!ordinary.count(error, error, k)) got.add({Outcome::finite, {error}, 0, true}, k);
  }
  ordinary.add_to(got);
  expect_equal(want, got);
  EXPECT_FALSE(ordinary.count(0.24, 0.26, 1)) << "two buckets";
}

TEST(Histogram, Quantiles) {
  UlpHistogram h;
  EXPECT_TRUE(std::isnan(h.quantile(0.5)));
  for (int i = 0; i < 98; ++i) h.add({0});
  h.add({0.5});
  h.add({4});
  EXPECT_EQ(h.quantile(0.5), 0);
  EXPECT_EQ(h.quantile(0.99), 0.5);
  EXPECT_EQ(h.quantile(1), 4);
}

Summary random_part(std::mt19937& random, std::uint64_t first, std::uint64_t last) {
  Summary s;
  for (std::uint64_t k = first; k < last; ++k) {
    Judgement j;
    j.error = {std::exp2(static_cast<double>(random() % 64) - 40) * static_cast<double>(random() % 7)};
    j.distance = std::floor(j.error.value);
    j.correctly_rounded = j.error.value <= 0.5;
    if (random() % 10 == 0) j.outcome = static_cast<Outcome>(1 + random() % 9);
    s.add(j, k);
  }
  return s;
}

TEST(Summary, MergesInAnyOrder) {
  std::mt19937 random(7);
  std::vector<Summary> parts;
  for (std::uint64_t i = 0; i < 20; ++i) parts.push_back(random_part(random, 50 * i, 50 * i + 50));
  Summary forwards;
  for (const auto& p : parts) forwards.merge(p);
  std::shuffle(parts.begin(), parts.end(), random);
  Summary shuffled;
  for (const auto& p : parts) shuffled.merge(p);
  expect_equal(forwards, shuffled);
}

TEST(Summary, TiesGoToTheLowestIndex) {
  Summary a;
  Summary b;
  a.add({Outcome::finite, {0.5}, 0, true}, 9);
  b.add({Outcome::finite, {0.5}, 0, true}, 3);
  a.merge(b);
  EXPECT_EQ(a.max_error.index, 3U);
}

TEST(UlpSum, IsExactAndTextRoundTrips) {
  UlpSum sum;
  for (std::uint64_t k = 0; k < 1000; ++k) sum.add({0.1}, k);
  sum.add({HUGE_VAL}, 1000);
  EXPECT_EQ(UlpSum::from_text(sum.to_text()).to_text(), sum.to_text());
  UlpSum edges;
  for (std::uint64_t k = 0; k < 4; ++k) edges.add({0.25}, k);
  EXPECT_EQ(edges.mean(4), 0.25) << "an edge is rounded to itself";
}

TEST(UlpSum, TheMeanOfRoundedErrorsIsTheMean) {
  for (const double error : {0.1, 0.3, 0.49, 3.3}) {
    UlpSum sum;
    for (std::uint64_t k = 0; k < 100000; ++k) sum.add({error}, k);
    EXPECT_NEAR(sum.mean(100000), error, error * 2e-3);
  }
}

TEST(SummaryText, ComesBackAsItWas) {
  Summary s;
  for (std::uint64_t k = 0; k < 50; ++k)
    s.add({Outcome::finite, {0.37 * static_cast<double>(k * k)}, static_cast<double>(k), k == 0}, k + 5);
  s.add({Outcome::nan, {}, 0, false}, 3);
  s.max_error_over_condition = HUGE_VAL;
  s.normwise.add(0.1, 17);
  s.oracle = {7, 1, {1e-300, 12}};
  for (const Summary& original : {s, Summary{}}) {
    const std::string text = summary_to_text(original);
    const auto back = summary_from_text(text);
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(summary_to_text(*back), text);
    EXPECT_EQ(back->samples, original.samples);
    EXPECT_EQ(back->outcomes, original.outcomes);
    EXPECT_EQ(back->first_index, original.first_index);
    EXPECT_EQ(back->max_error.value, original.max_error.value);
    EXPECT_EQ(back->max_error.index, original.max_error.index);
    EXPECT_EQ(back->histogram.counts, original.histogram.counts);
    EXPECT_EQ(back->sum.to_text(), original.sum.to_text());
    EXPECT_EQ(back->max_error_over_condition, original.max_error_over_condition);
    EXPECT_EQ(back->normwise.index, original.normwise.index);
    EXPECT_EQ(back->oracle.difference.value, original.oracle.difference.value);
    // No prefix and no longer text is taken for a summary.
    for (std::size_t n = 0; n < text.size(); ++n) {
      if (text[n] != ' ') continue;
      EXPECT_FALSE(summary_from_text(text.substr(0, n)).has_value()) << n;
    }
    EXPECT_FALSE(summary_from_text(text + " 1").has_value());
  }
}

}  // namespace
}  // namespace ulpgate
