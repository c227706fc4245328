// Interrupt: Ctrl-C and SIGTERM end a run after what is in hand; what is done is still written.
#pragma once

namespace ulpgate::app {

[[nodiscard]] bool interrupted();

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
