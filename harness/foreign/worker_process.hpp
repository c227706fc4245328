// WorkerProcess: one worker, its channel, and what becomes of it.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <span>
#include <string>

#include "harness/foreign/foreign_spec.hpp"
#include "harness/worker/worker_channel.h"

namespace ulpgate {

// How a request ended.
enum class WorkerEnd { answered, crashed, hung };

// Of one thread: it dies with the thread that started it.  Restarted by its owner, never by itself.
class WorkerProcess {
 public:
  // Starts a worker and waits until it is ready.  Throws ForeignFailure where it is refused, crashes or hangs
  // while it loads.
  WorkerProcess(const ForeignSpec& spec, const std::string& program);
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  ~WorkerProcess();

  [[nodiscard]] ulpgate_channel& channel() { return *channel_; }
  [[nodiscard]] const ulpgate_channel& channel() const { return *channel_; }

  // Of `count` points whose arguments stand in the channel, so many times over.  After a crash or a hang
  // there is no process any more, and channel().progress names the point.
  [[nodiscard]] WorkerEnd request(std::uint32_t count, ulpgate_worker_mode mode, std::uint32_t rounds = 1);
  // What ended it: "SIGSEGV", "exit code 3".
  [[nodiscard]] const std::string& why() const { return why_; }

 private:
  void start(const ForeignSpec& spec, const std::string& program);
  void wait_until_ready(const ForeignSpec& spec);
  // False once it is gone.
  [[nodiscard]] bool is_alive();
  [[nodiscard]] double processor_seconds() const;
  void end();

  ulpgate_channel* channel_ = nullptr;
  pid_t pid_ = -1;
  double timeout_s_;
  std::string why_;
};

// The program of the workers: $ULPGATE_WORKER, else ulpgate-worker beside this program or where it was
// installed.
[[nodiscard]] std::string worker_program();

}  // namespace ulpgate
