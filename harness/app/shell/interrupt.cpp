// Interrupt.
#include "harness/app/shell/interrupt.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

std::atomic<bool> asked_to_stop{false};
std::atomic<std::int64_t> first_ms{-1};

std::int64_t now_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1000} * now.tv_sec + now.tv_nsec / 1'000'000;
}

void on_interrupt(int) {
  asked_to_stop.store(true, std::memory_order_relaxed);
  // A terminal and the program that started this one may both pass one Ctrl-C on.
  constexpr std::int64_t same_ms = 500;
  const std::int64_t now = now_ms();
  std::int64_t first = -1;
  if (first_ms.compare_exchange_strong(first, now) || now - first < same_ms) return;
  // Whoever asks twice does not want to wait for what is in hand; what was finished is on disk.
  constexpr const char* words = "ulpgate: ended at once; what was finished before is kept\n";
  const ssize_t ignored = ::write(STDERR_FILENO, words, std::strlen(words));
  static_cast<void>(ignored);
  ::_exit(exit_code(Standing::incomplete));
}

// Guards may stand within each other: SIGHUP is the outermost one's.
int guards = 0;
void (*hangup_before)(int) = SIG_DFL;

// A program started by nohup has no use for the end of its terminal.
void set_hangup() {
  hangup_before = std::signal(SIGHUP, on_interrupt);
  if (hangup_before == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

}  // namespace

bool interrupted() {
  return asked_to_stop.load(std::memory_order_relaxed);
}

const std::atomic<bool>& interrupt_flag() {
  return asked_to_stop;
}

void interrupt() {
  asked_to_stop.store(true, std::memory_order_relaxed);
}

InterruptGuard::InterruptGuard()
    : int_(std::signal(SIGINT, on_interrupt)), term_(std::signal(SIGTERM, on_interrupt)) {
  if (guards++ == 0) set_hangup();
  asked_to_stop = false;
  first_ms = -1;
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, int_);
  std::signal(SIGTERM, term_);
  if (--guards == 0) std::signal(SIGHUP, hangup_before);
}

}  // namespace ulpgate::app
