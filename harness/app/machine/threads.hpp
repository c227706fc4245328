// Threads: some threads that do one kind of work, of which all are started or none.
#pragma once

#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace ulpgate::app {

class Threads {
 public:
  // Calls work(i) for i = first..last-1, each in a thread of its own.  Where one cannot be created none of
  // them works, and a Failure says so: nobody's function is to blame.
  Threads(unsigned first, unsigned last, std::function<void(unsigned)> work);
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
  ~Threads();
  // Waits for all; throws what the first of them threw.
  void join();

 private:
  void wait();

  std::function<void(unsigned)> work_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace ulpgate::app
