// Progress: a bar with the time left on a terminal, nothing in a pipe.
#pragma once

#include <chrono>
#include <string>

namespace ulpgate::app {

class Progress {
 public:
  explicit Progress(std::string what);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();
  // `done` of `total` in any one unit of work; draws at most ten times a second.
  void update(double done, double total);
  // The same with the caller's own estimate of the time left.
  void update(double done, double total, double left_s);
  // Takes the bar off the line before something else is written.
  void clear();
  // Whether anything is drawn at all, and whether it is time to draw again.
  [[nodiscard]] bool is_shown() const { return terminal_; }
  [[nodiscard]] bool is_due() const;

 private:
  void draw(double fraction, double left_s);

  std::string what_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace ulpgate::app
