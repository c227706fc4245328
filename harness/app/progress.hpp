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

 private:
  std::string what_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace ulpgate::app
