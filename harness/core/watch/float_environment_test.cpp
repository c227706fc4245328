// FloatEnvironment: what is set in the registers is seen, whichever unit of the processor it is set in.
#include "harness/core/watch/float_environment.hpp"

#include <gtest/gtest.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace ulpgate {
namespace {

TEST(FloatEnvironment, AProgramStartsInTheStandardOne) {
  EXPECT_EQ(FloatEnvironment::now(), FloatEnvironment::standard());
  EXPECT_EQ(FloatEnvironment::now().deviation(), "");
}

#if defined(__x86_64__)

void set_x87(std::uint16_t word) {
  __asm__ volatile("fldcw %0" : : "m"(word));
}

std::string deviation_and_restore() {
  const std::string text = FloatEnvironment::now().deviation();
  FloatEnvironment::standard().restore();
  return text;
}

TEST(FloatEnvironment, A8MxcsrIsReadFromItsRegister) {
  const unsigned before = _mm_getcsr();
  const struct {
    unsigned bits;
    const char* words;
  } cases[] = {{0x2000, "MXCSR rounding downward"},
               {0x4000, "MXCSR rounding upward"},
               {0x6000, "MXCSR rounding toward zero"},
               {0x8000, "MXCSR flushing subnormal results to zero"},
               {0x0040, "MXCSR taking subnormal operands as zero"}};
  for (const auto& c : cases) {
    _mm_setcsr(before | c.bits);
    EXPECT_EQ(deviation_and_restore(), c.words);
    EXPECT_EQ(FloatEnvironment::now(), FloatEnvironment::standard());
  }
  // Flags of what has happened are no deviation.
  _mm_setcsr(before | 0x3f);
  EXPECT_EQ(deviation_and_restore(), "");
}

TEST(FloatEnvironment, A8TheX87WordIsReadFromItsRegister) {
  const struct {
    std::uint16_t word;
    const char* words;
  } cases[] = {{0x027f, "x87 precision of 53 bits"},
               {0x007f, "x87 precision of 24 bits"},
               {0x077f, "x87 rounding downward"},
               {0x0b7f, "x87 rounding upward"},
               {0x0e7f, "x87 rounding toward zero, x87 precision of 53 bits"}};
  for (const auto& c : cases) {
    set_x87(c.word);
    EXPECT_EQ(deviation_and_restore(), c.words);
    EXPECT_EQ(FloatEnvironment::now(), FloatEnvironment::standard());
  }
}

#endif

}  // namespace
}  // namespace ulpgate
