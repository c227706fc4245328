// Progress.
#include "harness/app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace ulpgate::app {

using Clock = std::chrono::steady_clock;

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(::isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
}

void Progress::update(double done, double total) {
  if (!terminal_ || total <= 0) return;
  const auto now = Clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  const double fraction = done / total;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const auto filled = static_cast<std::size_t>(30 * fraction);
  std::string left = "";
  if (fraction > 0.005) {
    const auto left_s = static_cast<long>(elapsed_s * (1 - fraction) / fraction);
    left = fmt::format(", {}:{:02} left", left_s / 60, left_s % 60);
  }
  fmt::print(stderr, "\r\033[K{} [{}{}] {:.1f} %{}", what_, std::string(filled, '#'),
             std::string(30 - filled, '.'), 100 * fraction, left);
  std::fflush(stderr);
}

}  // namespace ulpgate::app
