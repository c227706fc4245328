// Interrupt: Ctrl-C and SIGTERM end a run after what is in hand; what is done is still written.
#pragma once

#include <atomic>

namespace ulpgate::app {

[[nodiscard]] bool interrupted();
// The flag itself, for loops of a lower layer.
[[nodiscard]] const std::atomic<bool>& interrupt_flag();
// Ends the run from inside, as a signal does.
void interrupt();

// While alive, SIGINT and SIGTERM set the flag instead of ending the program.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

 private:
  void (*int_)(int);
  void (*term_)(int);
};

}  // namespace ulpgate::app
