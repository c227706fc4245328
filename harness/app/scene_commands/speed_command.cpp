// ulpgate scene speed: iterations per second of a scene by the paper's protocol.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numeric>

#include "harness/app/scene_commands/scene_commands.hpp"
#include "harness/app/scene_commands/scene_options.hpp"
#include "harness/app/scenes/watched_steps.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/interrupt.hpp"
#include "harness/app/store/records.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

struct Moments {
  double mean = 0, deviation = 0;
};

Moments moments(const std::vector<double>& x) {
  const double n = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  double squares = 0;
  for (const double v : x) squares += (v - mean) * (v - mean);
  return {mean, n > 1 ? std::sqrt(squares / (n - 1)) : 0.0};
}

struct Repeats {
  std::vector<double> rates;     // iterations per second
  std::size_t memory_bytes = 0;  // of the last one at its end
};

// Repeats from the start, each after one untimed step; fewer after Ctrl-C.
Repeats repeats_of(const std::string& token, const SceneJob& job, unsigned repeats) {
  using Clock = std::chrono::steady_clock;
  Repeats done;
  for (unsigned r = 0; r < repeats && !interrupted(); ++r) {
    const auto engine = engine_of(token, dem::Level::own, job);
    take_steps(*engine, 1, job);
    const auto start = Clock::now();
    take_steps(*engine, job.steps, job);
    done.rates.push_back(static_cast<double>(job.steps) /
                         std::chrono::duration<double>(Clock::now() - start).count());
    done.memory_bytes = engine->memory_bytes();
    // The time of a step that computes with NaN is not that of the scene.
    if (const auto lost = finite_watch(token, dem::Level::own, job).look(*engine))
      throw Failure(Standing::not_finite, diverged_text(job, token, *lost));
  }
  return done;
}

// Points outside two standard deviations are dropped.
Json row_of(const std::string& token, const SceneJob& job, const Repeats& done) {
  const std::vector<double>& rates = done.rates;
  const Moments all = moments(rates);
  std::vector<double> kept;
  for (const double v : rates) {
    if (std::fabs(v - all.mean) <= 2 * all.deviation) kept.push_back(v);
  }
  if (kept.empty()) kept = rates;
  const Moments of_kept = moments(kept);
  return {{"what", "scene"},
          {"scene", job.loaded.scene.name},
          {"type", token},
          {"threads", job.threads},
          {"steps", job.steps},
          {"repeats", rates.size()},
          {"kept", kept.size()},
          {"iterations_per_s", of_kept.mean},
          {"deviation", of_kept.deviation},
          {"memory_bytes", done.memory_bytes}};
}

void print_row(const Json& row) {
  show("{:<12} {:<16} threads {}  {:>12.2f} +- {:.2f} iterations/s over {} of {} repeats of {} steps{}\n",
       row["scene"].get<std::string>(), row["type"].get<std::string>(), row["threads"].get<int>(),
       row["iterations_per_s"].get<double>(), row["deviation"].get<double>(), row["kept"].get<int>(),
       row["repeats"].get<int>(), row["steps"].get<std::uint64_t>(),
       row.contains("slowdown_against_double")
           ? fmt::format(", {:.2f} times slower than double", row["slowdown_against_double"].get<double>())
           : "");
}

Verdict measure(const SceneTask& task, unsigned repeats, bool json) {
  std::vector<Json> rows;
  double of_double = 0;
  // Ctrl-C ends the repeats in hand; what is done is still reported.
  const InterruptGuard guard;
  for (const auto& token : task.types) {
    const Repeats done = repeats_of(token, task.job, repeats);
    if (done.rates.empty()) break;
    rows.push_back(row_of(token, task.job, done));
    if (token == "double") of_double = rows.back()["iterations_per_s"];
  }
  std::string text;
  for (auto& row : rows) {
    if (of_double > 0) row["slowdown_against_double"] = of_double / row["iterations_per_s"].get<double>();
    text += row.dump() + "\n";
    if (!json) print_row(row);
  }
  if (json) fmt::print("{}", text);
  if (!task.records.out.empty()) task.records.directory->write("timing.jsonl", text);
  if (interrupted()) throw Failure(Standing::incomplete, "interrupted");
  return Standing::pass;
}

}  // namespace

void add_scene_speed_command(CLI::App& scene, Action& action) {
  auto o = std::make_shared<SceneOptions>();
  auto repeats = std::make_shared<unsigned>(10);
  add_scene_verb(
      scene, action, "speed", "Measure the iterations per second of a scene in each type",
      {"ulpgate scene speed collision --types float,double,mpfr62",
       "ulpgate scene speed deposition --types all --steps 500 --repeats 10 --out T"},
      o,
      [o, repeats](CLI::App& verb) {
        add_model_options(verb, *o);
        add_integrator_option(verb, *o);
        add_length_options(verb, *o);
        add_threads_option(verb, *o);
        add_all_parts_option(verb, *o);
        verb.add_option("--repeats", *repeats,
                        "runs from the start; those outside two standard deviations are dropped")
            ->capture_default_str()
            ->check(CLI::Range(1U, 1000000U));
        add_out_option(verb, *o);
        add_json_option(verb, *o);
      },
      [o, repeats] {
        // Only times are written: checkpoints of a run in the same directory stay.
        o->records.resume = true;
        return measure(make_task(*o, ""), *repeats, o->json);
      });
}

}  // namespace ulpgate::app
