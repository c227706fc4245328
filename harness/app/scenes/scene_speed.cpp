// The speed of a scene: what leaving out saves, and iterations per second by the paper's protocol.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>

#include "harness/app/scenes/scene_job.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

namespace {

double seconds_per_step(dem::DemEngine& engine) {
  using Clock = std::chrono::steady_clock;
  engine.step(1);
  // Grow the count until it takes long enough to be told from the clock's grain; keep the best of three.
  double best = HUGE_VAL;
  std::uint64_t count = 1;
  for (int kept = 0; kept < 3;) {
    const auto start = Clock::now();
    engine.step(count);
    const double taken = std::chrono::duration<double>(Clock::now() - start).count();
    if (taken < 0.05) {
      count *= 4;
      continue;
    }
    best = std::min(best, taken / static_cast<double>(count));
    ++kept;
  }
  return best;
}

// The paper's protocol: repeats from the start, each after one untimed step; points outside two standard
// deviations are dropped.
Json measure(const std::string& token, const SceneJob& job, const SceneOptions& o) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> rates;
  for (unsigned r = 0; r < o.repeats && !interrupted(); ++r) {
    const auto engine = engine_of(token, dem::Level::own, job, o, o.all_parts);
    engine->step(1);
    const auto start = Clock::now();
    engine->step(job.steps);
    rates.push_back(static_cast<double>(job.steps) /
                    std::chrono::duration<double>(Clock::now() - start).count());
  }
  const auto moments = [](const std::vector<double>& x) {
    const double n = static_cast<double>(x.size());
    const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
    double squares = 0;
    for (const double v : x) squares += (v - mean) * (v - mean);
    return std::pair(mean, n > 1 ? std::sqrt(squares / (n - 1)) : 0.0);
  };
  const auto [mean, deviation] = moments(rates);
  std::vector<double> kept;
  for (const double v : rates) {
    if (std::fabs(v - mean) <= 2 * deviation) kept.push_back(v);
  }
  if (kept.empty()) kept = rates;
  const auto [kept_mean, kept_deviation] = moments(kept);
  return {{"what", "scene"},
          {"scene", job.loaded.scene.name},
          {"type", token},
          {"threads", o.threads},
          {"steps", job.steps},
          {"repeats", rates.size()},
          {"kept", kept.size()},
          {"iterations_per_s", kept_mean},
          {"deviation", kept_deviation}};
}

}  // namespace

void explain_scene(const std::string& token, const SceneJob& job, const SceneOptions& o) {
  const auto lean = engine_of(token, dem::Level::own, job, o, false);
  const auto full = engine_of(token, dem::Level::own, job, o, true);
  fmt::print("{} in {}\n", job.loaded.scene.name, token);
  for (const auto& part : lean->explain().left_out)
    fmt::print("  left out: {:<12} {}\n", part.part, part.why);
  if (lean->explain().left_out.empty()) fmt::print("  nothing is left out\n");
  const std::size_t lean_bytes = lean->memory_bytes();
  const std::size_t full_bytes = full->memory_bytes();
  const double lean_ns = seconds_per_step(*lean) * 1e9;
  const double full_ns = seconds_per_step(*full) * 1e9;
  fmt::print("  {:<22} {:>14.1f} ns  {:>12} bytes\n", "step as it is", lean_ns, lean_bytes);
  fmt::print("  {:<22} {:>14.1f} ns  {:>12} bytes  {:.2f} times slower\n", "step with all parts", full_ns,
             full_bytes, full_ns / lean_ns);
}

ExitCode measure_scene(const SceneJob& job, const SceneOptions& o, const std::vector<std::string>& types,
                       const std::filesystem::path& out) {
  std::vector<Json> rows;
  double of_double = 0;
  // Ctrl-C ends the repeats in hand; what is done is still reported.
  const InterruptGuard guard;
  for (const auto& token : types) {
    if (interrupted()) break;
    rows.push_back(measure(token, job, o));
    if (token == "double") of_double = rows.back()["iterations_per_s"];
  }
  std::string text;
  for (auto& row : rows) {
    const double rate = row["iterations_per_s"];
    if (of_double > 0) row["slowdown_against_double"] = of_double / rate;
    text += row.dump() + "\n";
    fmt::print(
        "{:<12} {:<16} threads {}  {:>12.2f} +- {:.2f} iterations/s over {} of {} repeats of {} steps{}\n",
        job.loaded.scene.name, row["type"].get<std::string>(), o.threads, rate,
        row["deviation"].get<double>(), row["kept"].get<int>(), row["repeats"].get<int>(), job.steps,
        of_double > 0 ? fmt::format(", {:.2f} times slower than double", of_double / rate) : "");
  }
  if (!out.empty()) write_file(out / "timing.jsonl", text);
  if (interrupted()) throw Failure(ExitCode::incomplete, "interrupted");
  return ExitCode::pass;
}

// Threads that wait for each other's parts of a step must sleep where other programs share the cores:
// spinning costs ten times the step.  libgomp reads its policy before main, so the program starts itself
// again with it.
void let_waiting_threads_sleep(int threads) {
  if (threads < 2 || std::getenv("OMP_WAIT_POLICY") != nullptr) return;
  ::setenv("OMP_WAIT_POLICY", "passive", 1);
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string words((std::istreambuf_iterator<char>(in)), {});
  std::vector<char*> argv;
  for (std::size_t at = 0; at < words.size(); at += std::strlen(&words[at]) + 1) argv.push_back(&words[at]);
  argv.push_back(nullptr);
  // Where that fails the run is slower and no less right.
  ::execv("/proc/self/exe", argv.data());
}

}  // namespace ulpgate::app
