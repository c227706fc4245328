// Verdict: what a verb came to.  Whatever keeps a measurement from being one is a value of its own: NaN,
// nothing measured, less than planned, another plan or machine are never comparisons that happen to be false.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ulpgate {

// From the best to the one that outweighs all others.
enum class Standing : std::size_t {
  pass,              // all of it measured, and within what was asked
  incomplete,        // less was measured than planned
  nothing_measured,  // no sample, row or step that could be judged
  regression,        // a limit, a claim or an oracle is contradicted
  not_finite,        // NaN or infinity where a number is judged: diverged
  bad_input,         // usage or input that is no input
  another_plan,      // what is there belongs to another plan
  another_machine,   // what is there was computed where other bits may come out
  environment,       // crash, time-out, I/O, a resource that is not there
};
inline constexpr std::size_t standing_count = 9;

// The exit codes of every verb, here and nowhere else: 0 pass, 1 regression or divergence, 2 bad usage or
// input, 3 nothing measured or not all of it, 4 crash, time-out or I/O.
[[nodiscard]] int exit_code(Standing standing);
// And back, for a program that was started and keeps the same contract: environment where it does not.
[[nodiscard]] Standing standing_of(int exit_code);

// How often each standing was found; it stands as the gravest of them.
class Verdict {
 public:
  Verdict() = default;
  Verdict(Standing standing) {
    add(standing);
  }  // NOLINT(google-explicit-constructor): a standing is a verdict

  void add(Standing standing, std::uint64_t times = 1) {
    counts_[static_cast<std::size_t>(standing)] += times;
  }
  Verdict& operator|=(const Verdict& other);
  // Pass where nothing was added: whoever may have measured nothing asks `measured`.
  [[nodiscard]] Standing standing() const;
  [[nodiscard]] bool passes() const { return standing() == Standing::pass; }
  [[nodiscard]] std::uint64_t count(Standing standing) const {
    return counts_[static_cast<std::size_t>(standing)];
  }

 private:
  std::array<std::uint64_t, standing_count> counts_{};
};

// Whether all that was planned was measured.
[[nodiscard]] Standing measured(std::uint64_t done, std::uint64_t planned);
// Whether `value` is within the limit, which is a number: not_finite for NaN and infinity, and for a limit of
// NaN.
[[nodiscard]] Standing at_most(double value, double limit);
[[nodiscard]] Standing at_least(double value, double limit);

}  // namespace ulpgate
