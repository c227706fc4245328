// Interrupt.
#include "harness/app/shell/interrupt.hpp"

#include <csignal>

namespace ulpgate::app {

namespace {
std::atomic<bool> flag{false};
void on_interrupt(int) {
  flag.store(true, std::memory_order_relaxed);
}
}  // namespace

bool interrupted() {
  return flag.load(std::memory_order_relaxed);
}

const std::atomic<bool>& interrupt_flag() {
  return flag;
}

void interrupt() {
  flag.store(true, std::memory_order_relaxed);
}

InterruptGuard::InterruptGuard()
    : int_(std::signal(SIGINT, on_interrupt)), term_(std::signal(SIGTERM, on_interrupt)) {
  flag = false;
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, int_);
  std::signal(SIGTERM, term_);
}

}  // namespace ulpgate::app
