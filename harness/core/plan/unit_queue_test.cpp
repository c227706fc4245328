// Tests of the unit queue: every unit once, a silent taker's unit to another, results that come late.
#include "harness/core/plan/unit_queue.hpp"

#include <gtest/gtest.h>

namespace ulpgate {
namespace {

using Answer = UnitQueue::Answer;

TEST(UnitQueue, GivesEveryUnitThatIsNotDoneOnceAndInOrder) {
  UnitQueue queue({true, false, false, true, false}, 60);
  for (const std::size_t position : {1U, 2U, 4U}) {
    const auto taken = queue.take(position % 2, 0);
    ASSERT_EQ(taken.answer, Answer::unit);
    EXPECT_EQ(taken.position, position);
  }
  EXPECT_EQ(queue.take(0, 1).answer, Answer::wait);
  EXPECT_TRUE(queue.finish(4));
  EXPECT_TRUE(queue.finish(1));
  EXPECT_FALSE(queue.all_done());
  EXPECT_TRUE(queue.finish(2));
  EXPECT_TRUE(queue.all_done());
  EXPECT_EQ(queue.take(0, 2).answer, Answer::all_done);
}

TEST(UnitQueue, NothingToDoIsDoneAtOnce) {
  EXPECT_EQ(UnitQueue({}, 1).take(0, 0).answer, Answer::all_done);
  EXPECT_EQ(UnitQueue({true, true}, 1).take(0, 0).answer, Answer::all_done);
}

TEST(UnitQueue, AnOverdueUnitGoesToAnotherTakerAndCountsOnce) {
  UnitQueue queue({false, false}, 10);
  ASSERT_EQ(queue.take(1, 0).position, 0U);
  ASSERT_EQ(queue.take(2, 1).position, 1U);
  // Not yet overdue; never back to the taker who has it; the longest taken first.
  EXPECT_EQ(queue.take(3, 9).answer, Answer::wait);
  EXPECT_EQ(queue.take(1, 10.5).answer, Answer::wait);
  const auto again = queue.take(3, 20);
  ASSERT_EQ(again.answer, Answer::unit);
  EXPECT_EQ(again.position, 0U);
  // Its time starts anew.
  EXPECT_EQ(queue.take(4, 21).position, 1U);
  EXPECT_EQ(queue.take(5, 22).answer, Answer::wait);
  EXPECT_TRUE(queue.finish(0));
  EXPECT_FALSE(queue.finish(0));
  EXPECT_TRUE(queue.finish(1));
  EXPECT_TRUE(queue.all_done());
}

}  // namespace
}  // namespace ulpgate
