// Heartbeat: a thread that stands still is named with what it has in hand, one that gets on is not.
#include "harness/core/watch/heartbeat.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace ulpgate {
namespace {

class Numbers final : public WorkInHand {
 public:
  [[nodiscard]] std::size_t count() const override { return 3; }
  [[nodiscard]] std::string arguments(std::size_t i) const override { return std::to_string(i); }
  void repeat(std::size_t) const override {}
};

TEST(Heartbeat, AThreadThatGetsOnIsLeftAlone) {
  const WorkPlace place("sin", "double", "uniform");
  Watch watch;
  for (int i = 0; i < 5; ++i) {
    Heartbeat::mine().beat(WorkPhase::calls, 3);
    EXPECT_TRUE(watch.look(0.9, 1).empty());
  }
  // Steps counted by others are beats as well.
  for (int i = 0; i < 5; ++i) {
    ++Heartbeat::mine().steps();
    EXPECT_TRUE(watch.look(0.9, 1).empty());
  }
}

TEST(Heartbeat, APlaceOfFewerWordsEndsWithTheLast) {
  {
    const WorkPlace place("sin", "double", "");
    EXPECT_STREQ(WorkPlace::name(), "sin double");
  }
  {
    const WorkPlace place("sin", "", "");
    EXPECT_STREQ(WorkPlace::name(), "sin");
  }
  const WorkPlace none("", "", "");
  EXPECT_STREQ(WorkPlace::name(), "");
}

TEST(Heartbeat, AThreadWithoutWorkIsNotWatched) {
  Heartbeat::mine().beat(WorkPhase::none);
  Watch watch;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(watch.look(10, 1).empty());
}

// The thread is condemned in the end and never comes back.
TEST(Heartbeat, B5AThreadThatStandsStillIsNamedWithItsWork) {
  static const Numbers numbers;
  static std::atomic<bool> there{false};
  std::thread([] {
    const WorkPlace place("sin", "double", "uniform");
    EXPECT_STREQ(WorkPlace::name(), "sin double uniform");
    const HandScope hand(numbers);
    Heartbeat::mine().beat(WorkPhase::reference, 2);
    there = true;
    while (there) std::this_thread::yield();
    Heartbeat::mine().beat(WorkPhase::none);
    ADD_FAILURE() << "a condemned thread went on";
  }).detach();
  while (!there) std::this_thread::yield();
  Watch watch;
  EXPECT_TRUE(watch.look(5, 1).empty()) << "nothing is known of it yet";
  EXPECT_TRUE(watch.look(0.6, 1).empty());
  const auto stalled = watch.look(0.6, 1);
  ASSERT_EQ(stalled.size(), 1U);
  EXPECT_EQ(stalled[0].place, "sin double uniform");
  EXPECT_EQ(stalled[0].phase, WorkPhase::reference);
  EXPECT_EQ(stalled[0].point, 2U);
  EXPECT_EQ(stalled[0].work, &numbers);
  there = false;
}

}  // namespace
}  // namespace ulpgate
