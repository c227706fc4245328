// WorkerProcess.
#include "harness/foreign/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/futex.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <new>

#include "harness/core/watch/heartbeat.hpp"
#include "harness/foreign/foreign_failure.hpp"

extern char** environ;

namespace ulpgate {

namespace {

using Clock = std::chrono::steady_clock;

// Between two looks at a worker that does not answer.
constexpr long look_ns = 20'000'000;
// A worker that sleeps or waits takes no processor time: it hangs when so many times its timeout have passed.
constexpr double asleep = 20;
constexpr double loading_timeout_s = 30;

std::uint32_t load(const std::uint32_t& word) {
  return __atomic_load_n(&word, __ATOMIC_ACQUIRE);
}

void wait_while(std::uint32_t& word, std::uint32_t value) {
  const timespec most{0, look_ns};
  ::syscall(SYS_futex, &word, FUTEX_WAIT, value, &most, nullptr, 0);
}

std::string signal_name(int number) {
  const char* name = ::sigabbrev_np(number);
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("signal {}", number);
}

// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

template <class Error = ForeignFailure>
[[noreturn]] void fail(const ForeignSpec& spec, const std::string& why) {
  throw Error(fmt::format("{}, {}: {}", spec.library == "-" ? "the worker" : spec.library, spec.symbol, why));
}

// Throws what a worker says that will not serve.
void fail_where_refused(const ForeignSpec& spec, const ulpgate_channel& c) {
  const std::uint32_t state = load(c.state);
  if (state == ulpgate_worker_refused) fail(spec, c.message);
  if (state == ulpgate_worker_unsupported) fail<ForeignUnsupported>(spec, c.message);
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all;
  const auto name_of = [](std::string_view entry) { return entry.substr(0, entry.find('=')); };
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const auto same = [&](const std::string& m) { return name_of(m) == name_of(*entry); };
    if (std::ranges::none_of(more, same)) all.emplace_back(*entry);
  }
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> out;
  out.reserve(words.size() + 1);
  for (auto& w : words) out.push_back(w.data());
  out.push_back(nullptr);
  return out;
}

}  // namespace

WorkerProcess::WorkerProcess(const ForeignSpec& spec, const std::string& program)
    : timeout_s_(spec.timeout_s) {
  start(spec, program);
  try {
    wait_until_ready(spec);
  } catch (...) {
    end();
    ::munmap(channel_, sizeof(ulpgate_channel));
    throw;
  }
}

WorkerProcess::~WorkerProcess() {
  end();
  if (channel_ != nullptr) ::munmap(channel_, sizeof(ulpgate_channel));
}

void WorkerProcess::start(const ForeignSpec& spec, const std::string& program) {
  const Descriptor fd(::memfd_create("ulpgate-channel", MFD_CLOEXEC));
  if (fd.get() < 0 || ::ftruncate(fd.get(), sizeof(ulpgate_channel)) != 0)
    fail(spec, fmt::format("no shared memory: {}", std::strerror(errno)));
  void* memory = ::mmap(nullptr, sizeof(ulpgate_channel), PROT_READ | PROT_WRITE, MAP_SHARED, fd.get(), 0);
  if (memory == MAP_FAILED) fail(spec, fmt::format("no shared memory: {}", std::strerror(errno)));
  channel_ = static_cast<ulpgate_channel*>(memory);
  channel_->magic = ulpgate_channel_magic;
  channel_->version = ulpgate_channel_version;

  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  // What a library prints is no result of ours.
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, fd.get(), ulpgate_channel_fd);
  ::posix_spawn_file_actions_addclosefrom_np(&files, ulpgate_channel_fd + 1);
  // Ctrl-C is for the harness, which ends its workers itself.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  sigset_t none;
  ::sigemptyset(&none);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::posix_spawnattr_setsigmask(&attributes, &none);
  std::vector<std::string> words = {program, spec.library, spec.symbol, spec.signature};
  std::vector<std::string> variables = environment_with(spec.environment);
  const auto argv = pointers_to(words);
  const auto envp = pointers_to(variables);
  const int error = ::posix_spawn(&pid_, program.c_str(), &files, &attributes, argv.data(), envp.data());
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  if (error != 0) {
    pid_ = -1;
    ::munmap(channel_, sizeof(ulpgate_channel));
    throw ForeignFailure(fmt::format("the worker {} cannot be started: {}", program, std::strerror(error)));
  }
}

void WorkerProcess::wait_until_ready(const ForeignSpec& spec) {
  const auto start = Clock::now();
  for (;;) {
    const std::uint32_t state = load(channel_->state);
    if (state == ulpgate_worker_ready) return;
    fail_where_refused(spec, *channel_);
    const bool alive = state != ulpgate_worker_signalled && is_alive();
    // It may have got on in between.
    if (!alive) {
      fail_where_refused(spec, *channel_);
      const bool signalled = load(channel_->state) == ulpgate_worker_signalled;
      fail(spec, fmt::format("its worker ended while loading: {}",
                             signalled ? signal_name(channel_->signal) : why_));
    }
    if (std::chrono::duration<double>(Clock::now() - start).count() > loading_timeout_s)
      fail(spec, fmt::format("not loaded within {} s", loading_timeout_s));
    wait_while(channel_->state, state);
  }
}

bool WorkerProcess::is_alive() {
  if (pid_ < 0) return false;
  int status = 0;
  pid_t ended = 0;
  do {
    ended = ::waitpid(pid_, &status, WNOHANG);
  } while (ended < 0 && errno == EINTR);
  if (ended == 0) return true;
  pid_ = -1;
  why_ = ended < 0             ? "it is gone"
         : WIFSIGNALED(status) ? signal_name(WTERMSIG(status))
                               : fmt::format("exit code {}", WEXITSTATUS(status));
  return false;
}

double WorkerProcess::processor_seconds() const {
  clockid_t clock{};
  timespec t{};
  if (::clock_getcpuclockid(pid_, &clock) != 0 || ::clock_gettime(clock, &t) != 0) return 0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

WorkerEnd WorkerProcess::request(std::uint32_t count, ulpgate_worker_mode mode, std::uint32_t rounds) {
  ulpgate_channel& c = *channel_;
  c.count = count;
  c.mode = mode;
  c.rounds = rounds;
  const std::uint32_t before = load(c.reply);
  const std::uint32_t wanted = before + 1;
  __atomic_store_n(&c.progress, std::uint64_t{0}, __ATOMIC_RELAXED);
  __atomic_store_n(&c.request, wanted, __ATOMIC_RELEASE);
  ::syscall(SYS_futex, &c.request, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
  std::uint64_t point = 0;
  double moved_cpu_s = -1;
  auto moved = Clock::now();
  for (;;) {
    wait_while(c.reply, before);
    if (load(c.reply) == wanted) return WorkerEnd::answered;
    if (load(c.state) == ulpgate_worker_signalled) {
      why_ = signal_name(c.signal);
      end();
      return WorkerEnd::crashed;
    }
    if (!is_alive()) {
      // Its last words may be an answer.
      if (load(c.reply) == wanted) return WorkerEnd::answered;
      if (load(c.state) == ulpgate_worker_signalled) why_ = signal_name(c.signal);
      return WorkerEnd::crashed;
    }
    // The watchdog of this thread looks at the worker through it.
    Heartbeat::mine().steps().fetch_add(1, std::memory_order_relaxed);
    const std::uint64_t at = __atomic_load_n(&c.progress, __ATOMIC_RELAXED);
    const double cpu_s = processor_seconds();
    if (at != point || moved_cpu_s < 0) {
      point = at;
      moved_cpu_s = cpu_s;
      moved = Clock::now();
      continue;
    }
    const double waited_s = std::chrono::duration<double>(Clock::now() - moved).count();
    if (cpu_s - moved_cpu_s > timeout_s_ || waited_s > asleep * timeout_s_) {
      why_ = fmt::format("no return in {:.2g} s", timeout_s_);
      end();
      return WorkerEnd::hung;
    }
  }
}

void WorkerProcess::end() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
  }
}

std::string worker_program() {
  if (const char* named = std::getenv("ULPGATE_WORKER"); named != nullptr && *named != '\0') return named;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto beside = self.parent_path() / "ulpgate-worker";
  if (!error && std::filesystem::exists(beside, error)) return beside.string();
  const auto installed = self.parent_path().parent_path() / "libexec" / "ulpgate" / "ulpgate-worker";
  if (std::filesystem::exists(installed, error)) return installed.string();
  throw ForeignFailure(
      fmt::format("there is no ulpgate-worker beside {} ($ULPGATE_WORKER names one)", self.string()));
}

}  // namespace ulpgate
