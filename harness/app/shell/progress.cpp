// Progress.
#include "harness/app/shell/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ulpgate::app {

using Clock = std::chrono::steady_clock;

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(::isatty(STDERR_FILENO) == 1), start_(Clock::now()), last_(start_) {}

Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

bool Progress::is_due() const {
  return terminal_ && (!drawn_ || Clock::now() - last_ >= std::chrono::milliseconds(100));
}

void Progress::update(double done, double total) {
  if (total <= 0 || !is_due()) return;
  const double fraction = done / total;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  draw(fraction, fraction > 0.005 ? elapsed_s * (1 - fraction) / fraction : -1);
}

void Progress::update(double done, double total, double left_s) {
  if (total > 0 && is_due()) draw(done / total, left_s);
}

void Progress::draw(double fraction, double left_s) {
  last_ = Clock::now();
  drawn_ = true;
  const auto filled = static_cast<std::size_t>(30 * std::clamp(fraction, 0.0, 1.0));
  std::string left;
  if (left_s >= 3600) {
    const auto minutes = std::lround(left_s / 60);
    left = fmt::format(", {} h {:02} min left", minutes / 60, minutes % 60);
  } else if (left_s >= 0) {
    const auto seconds = std::lround(left_s);
    left = fmt::format(", {}:{:02} left", seconds / 60, seconds % 60);
  }
  fmt::print(stderr, "\r\033[K{} [{}{}] {:.1f} %{}", what_, std::string(filled, '#'),
             std::string(30 - filled, '.'), 100 * fraction, left);
  std::fflush(stderr);
}

}  // namespace ulpgate::app
