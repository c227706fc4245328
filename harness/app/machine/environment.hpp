// The floating-point environment around the work of a thread: looked at where work begins and where it ends.
#pragma once

#include <string_view>

namespace ulpgate::app {

// Throws a Failure unless rounding, precision and subnormals are as the types want them, in the registers
// that decide.
void assert_floating_point_environment();

// After a piece of work in the calling thread: a Failure where `what` left another environment behind, which
// is restored first; the work is void then.  An empty `what` stands for the thread's WorkPlace.
void check_environment(std::string_view what = {});

// The same of the OpenMP threads that the calling thread computes with, itself among them.
void check_environment_of_team(int threads);

// Does work and checks what it left; work that throws may throw because of the environment.
template <class Work>
auto in_checked_environment(const Work& work) {
  try {
    auto result = work();
    check_environment();
    return result;
  } catch (...) {
    check_environment();
    throw;
  }
}

}  // namespace ulpgate::app
