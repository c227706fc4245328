// Threads.
#include "harness/app/machine/threads.hpp"

#include <fmt/format.h>

#include <future>
#include <new>
#include <system_error>
#include <utility>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

Threads::Threads(unsigned first, unsigned last, std::function<void(unsigned)> work) : work_(std::move(work)) {
  std::promise<bool> go;
  const std::shared_future<bool> all_there = go.get_future().share();
  const auto run = [this, all_there](unsigned i) {
    if (!all_there.get()) return;
    try {
      work_(i);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
    }
  };
  std::string why;
  try {
    for (unsigned i = first; i < last; ++i) threads_.emplace_back(run, i);
  } catch (const std::system_error& e) {
    why = e.code().message();
  } catch (const std::bad_alloc&) {
    why = "out of memory";
  }
  const auto started = threads_.size();
  go.set_value(why.empty());
  if (why.empty()) return;
  wait();
  throw Failure(Standing::environment,
                fmt::format("cannot start thread {} of {}: {}; --threads asks for fewer", started + 1,
                            last - first, why));
}

Threads::~Threads() {
  wait();
}

void Threads::wait() {
  for (auto& thread : threads_)
    if (thread.joinable()) thread.join();
}

void Threads::join() {
  wait();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace ulpgate::app
