// Tests of merging: every figure comes with the point that it belongs to.
#include "harness/core/records/row_record.hpp"

#include <gtest/gtest.h>

namespace ulpgate {
namespace {

// A row of one sample of number `index` with this error, whose points are named by `name`.
RowRecord one(std::uint64_t index, double error, const std::string& name) {
  RowRecord r;
  r.subject = "sin";
  r.summary.add({Outcome::finite, {error}, 0, false}, index);
  r.points.argmax = {name};
  r.points.got = "got " + name;
  r.points.exact = "exact " + name;
  r.points.normwise_argmax = {"normwise " + name};
  r.points.oracle_argmax = {"oracle " + name};
  return r;
}

TEST(RowRecord, TheLargerErrorBringsItsPoint) {
  for (const bool other_first : {false, true}) {
    RowRecord a = one(0, 1, "a");
    RowRecord b = one(1, 2, "b");
    RowRecord& into = other_first ? b : a;
    merge_record(into, other_first ? a : b);
    EXPECT_EQ(into.summary.samples, 2U);
    EXPECT_EQ(into.summary.max_error.value, 2);
    EXPECT_EQ(into.points.argmax, std::vector<std::string>{"b"});
    EXPECT_EQ(into.points.got, "got b");
    EXPECT_EQ(into.points.exact, "exact b");
  }
}

TEST(RowRecord, TheFirstMismatchIsTheLowestOfBoth) {
  for (const bool other_first : {false, true}) {
    RowRecord a = one(0, 1, "a");
    RowRecord b = one(1, 1, "b");
    a.summary.add({Outcome::nan, {}, 0, false}, 5);
    a.points.first_mismatch[Outcome::nan] = {"fifth"};
    b.summary.add({Outcome::nan, {}, 0, false}, 3);
    b.points.first_mismatch[Outcome::nan] = {"third"};
    RowRecord& into = other_first ? b : a;
    merge_record(into, other_first ? a : b);
    EXPECT_EQ(into.points.first_mismatch.at(Outcome::nan), std::vector<std::string>{"third"});
    EXPECT_EQ(into.summary.outcomes[static_cast<std::size_t>(Outcome::nan)], 2U);
  }
}

TEST(RowRecord, NormwiseAndOraclePointsComeWithTheirFigures) {
  for (const bool other_first : {false, true}) {
    RowRecord a = one(0, 1, "a");
    RowRecord b = one(1, 1, "b");
    a.points.condition = 7;
    b.points.condition = 9;
    a.summary.normwise.value = 1;
    a.summary.normwise.index = 0;
    b.summary.normwise.value = 4;
    b.summary.normwise.index = 1;
    a.summary.oracle.difference = {1, 0};
    b.summary.oracle.difference = {4, 1};
    RowRecord& into = other_first ? b : a;
    merge_record(into, other_first ? a : b);
    EXPECT_EQ(into.points.normwise_argmax, std::vector<std::string>{"normwise b"});
    EXPECT_EQ(into.points.condition, 9);
    EXPECT_EQ(into.points.oracle_argmax, std::vector<std::string>{"oracle b"});
    // Of equal errors the one of the lowest number stands.
    EXPECT_EQ(into.points.argmax, std::vector<std::string>{"a"});
  }
}

}  // namespace
}  // namespace ulpgate
