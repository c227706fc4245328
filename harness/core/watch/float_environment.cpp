// FloatEnvironment.
#include "harness/core/watch/float_environment.hpp"

#include <array>
#include <cfenv>
#include <limits>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace ulpgate {

namespace {

void add(std::string& text, const std::string& part) {
  text += (text.empty() ? "" : ", ") + part;
}

#if defined(__x86_64__)
// Control bits; the others are flags of what has happened.
constexpr std::uint32_t sse_control = 0xffc0;
constexpr std::uint32_t x87_control = 0x0f3f;
constexpr std::uint32_t sse_daz = 0x0040;
constexpr std::uint32_t sse_traps = 0x1f80;
constexpr std::uint32_t sse_ftz = 0x8000;
constexpr std::uint32_t x87_traps = 0x003f;
constexpr std::array roundings = {"to nearest", "downward", "upward", "toward zero"};

std::uint32_t x87_word() {
  std::uint16_t word = 0;
  __asm__ volatile("fnstcw %0" : "=m"(word));
  return word;
}

#endif

}  // namespace

#if defined(__x86_64__)

FloatEnvironment FloatEnvironment::now() {
  return {_mm_getcsr() & sse_control, x87_word() & x87_control};
}

FloatEnvironment FloatEnvironment::standard() {
  return {sse_traps, 0x0300 | x87_traps};
}

void FloatEnvironment::restore() const {
  _mm_setcsr((_mm_getcsr() & ~sse_control) | sse);
  const auto word = static_cast<std::uint16_t>((x87_word() & ~x87_control) | x87);
  __asm__ volatile("fldcw %0" : : "m"(word));
}

std::string FloatEnvironment::deviation() const {
  std::string text;
  if ((sse >> 13U & 3U) != 0) add(text, std::string("MXCSR rounding ") + roundings[sse >> 13U & 3U]);
  if ((sse & sse_ftz) != 0) add(text, "MXCSR flushing subnormal results to zero");
  if ((sse & sse_daz) != 0) add(text, "MXCSR taking subnormal operands as zero");
  if ((sse & sse_traps) != sse_traps) add(text, "MXCSR trapping exceptions");
  if ((x87 >> 10U & 3U) != 0) add(text, std::string("x87 rounding ") + roundings[x87 >> 10U & 3U]);
  if ((x87 >> 8U & 3U) != 3U)
    add(text, std::string("x87 precision of ") + ((x87 >> 8U & 3U) == 2U ? "53" : "24") + " bits");
  if ((x87 & x87_traps) != x87_traps) add(text, "x87 trapping exceptions");
  return text;
}

#else

FloatEnvironment FloatEnvironment::now() {
  volatile double least_normal = std::numeric_limits<double>::min();
  volatile double subnormal = least_normal / 4;
  volatile double back = subnormal * 4;
  const bool flushed = subnormal == 0 || back != least_normal;
  return {static_cast<std::uint32_t>(std::fegetround()), flushed ? 1U : 0U};
}

FloatEnvironment FloatEnvironment::standard() {
  return {static_cast<std::uint32_t>(FE_TONEAREST), 0};
}

void FloatEnvironment::restore() const {
  std::fesetround(static_cast<int>(sse));
}

std::string FloatEnvironment::deviation() const {
  std::string text;
  if (sse != standard().sse) add(text, "rounding not to nearest");
  if (x87 != 0) add(text, "subnormal numbers flushed to zero");
  return text;
}

#endif

}  // namespace ulpgate
