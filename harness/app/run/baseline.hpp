// Baseline: fixed work, timed between all other work, that tells how steady the machine is.
#pragma once

namespace ulpgate::app {

// Seconds that `operations` dependent operations in double take: nothing of what is under test is called.
[[nodiscard]] double baseline_sample_s(int operations);

}  // namespace ulpgate::app
