// FloatEnvironment: rounding, precision and the treatment of subnormals, as the processor has them.
#pragma once

#include <cstdint>
#include <string>

namespace ulpgate {

// Of the calling thread.  On x86-64 the control bits of MXCSR (SSE) and of the x87 control word, which the C
// library's fegetround() reads but one of; elsewhere what C++ can ask and a probe with subnormal numbers.
struct FloatEnvironment {
  std::uint32_t sse = 0;
  std::uint32_t x87 = 0;

  [[nodiscard]] static FloatEnvironment now();
  // To nearest, x87 in its full precision, subnormals as they are, no exception trapped.
  [[nodiscard]] static FloatEnvironment standard();
  // Sets the control bits of the calling thread where `now` could read them.
  void restore() const;
  friend bool operator==(const FloatEnvironment&, const FloatEnvironment&) = default;

  // What is not as the standard wants it: "MXCSR rounding upward, x87 precision of 53 bits"; empty where all
  // is.
  [[nodiscard]] std::string deviation() const;
};

}  // namespace ulpgate
