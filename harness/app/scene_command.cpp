// ulpgate scene: runs a DEM scene, explains what it leaves out, compares it with RealHP<4>, measures its
// speed.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>

#include "harness/app/commands.hpp"
#include "harness/app/context.hpp"
#include "harness/app/files.hpp"
#include "harness/app/interrupt.hpp"
#include "harness/app/progress.hpp"
#include "harness/app/scene_files.hpp"
#include "harness/app/scene_output.hpp"
#include "harness/app/selection.hpp"
#include "harness/core/random_words.hpp"
#include "kernels/scenes/expression.hpp"
#include "kernels/scenes/scene_steps.hpp"

namespace ulpgate::app {

namespace {

struct SceneOptions {
  std::string name;
  std::string types = "double";
  std::vector<std::string> overrides;
  std::string dt;
  std::string until;
  std::uint64_t steps = 0;
  int threads = 1;
  bool all_parts = false;
  bool explain = false;
  bool compare = false;
  bool own_constants = false;
  bool ladder = false;
  bool record = false;
  bool vtk = false;
  std::string snapshots;
  unsigned repeats = 0;
  std::string out;
  bool json = false;
};

struct Job {
  LoadedScene loaded;
  std::uint64_t steps = 0;
  std::uint64_t record_every = 0;  // steps; 0: at the end only
  std::vector<std::uint64_t> snapshot_steps;
  std::string plan_text;
  std::string plan;
};

Job make_job(const SceneOptions& o) {
  Job job;
  auto overrides = o.overrides;
  if (!o.dt.empty()) overrides.push_back("dt=" + o.dt);
  if (!o.until.empty()) overrides.push_back("until=" + o.until);
  job.loaded = load_scene(o.name, overrides);
  scenes::Scene& scene = job.loaded.scene;
  // A record of a run keeps the energy account unless the scene's author left it out on purpose for a
  // comparison.
  if (o.record && !scene.records("energy")) {
    scene.record.emplace_back("energy");
    job.loaded.text += "\n# record energy";
  }
  job.steps = o.steps != 0 ? o.steps : scenes::steps_until_end(scene);
  if (job.steps == 0) throw Failure(ExitCode::bad_input, fmt::format("{}: no step to take", o.name));
  job.record_every = scenes::steps_between_records(scene);
  for (const auto& time : split(o.snapshots, ',')) {
    try {
      job.snapshot_steps.push_back(scenes::steps_for(scene, time));
    } catch (const scenes::ExpressionError& e) {
      throw Failure(ExitCode::bad_input, fmt::format("--snapshots: {}", e.what()));
    }
  }
  job.plan_text = fmt::format("ulpgate scene plan\nsteps {}\nscene {:016x}\n{}\n", job.steps,
                              fnv1a(job.loaded.text), job.loaded.text);
  job.plan = fmt::format("{:016x}", fnv1a(job.plan_text));
  return job;
}

std::unique_ptr<dem::DemEngine> engine_of(const std::string& token, dem::Level level, const Job& job,
                                          const SceneOptions& o, bool all_parts) {
  return dem::make_engine(token, level, job.loaded.scene, {all_parts, o.threads});
}

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

void explain(const std::string& token, const Job& job, const SceneOptions& o) {
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

ExitCode ladder(const std::string& token, const Job& job, const SceneOptions& o) {
  const RealDescriptor& type = type_or_fail(token).descriptor();
  if (type.format.precision <= 64) {
    fmt::print("{} in {}: the ladder needs a type of more digits than double\n", job.loaded.scene.name,
               token);
    return ExitCode::pass;
  }
  const auto engine = engine_of(token, dem::Level::own, job, o, false);
  const auto found = short_constants(*engine);
  for (const auto& constant : found) {
    fmt::print("{} in {}: {} = {} is good to 16 digits only: a double on the way\n", job.loaded.scene.name,
               token, constant.what, constant.value);
  }
  if (found.empty())
    fmt::print("{} in {}: every constant fills its precision\n", job.loaded.scene.name, token);
  return found.empty() ? ExitCode::pass : ExitCode::regression;
}

struct Written {
  Json record;
  bool complete = true;
};

void write_picture(const SceneOptions& o, const std::filesystem::path& out, const Job& job,
                   const std::string& token, const dem::DemEngine& engine) {
  const std::string stem = fmt::format("{}_{}_{}", job.loaded.scene.name, token, engine.iteration());
  make_directory(out / "snapshots");
  write_file(out / "snapshots" / (stem + ".csv"), snapshot_csv(engine));
  if (o.vtk) {
    make_directory(out / "vtk");
    write_file(out / "vtk" / (stem + ".vtk"), vtk_text(engine, stem));
  }
}

Written run_one(const std::string& token, const Job& job, const SceneOptions& o,
                const std::filesystem::path& out) {
  auto engine = engine_of(token, dem::Level::own, job, o, o.all_parts);
  std::unique_ptr<dem::DemEngine> reference;
  if (o.compare) {
    reference = engine_of(token, dem::Level::reference, job, o, o.all_parts);
    reference->restore(engine->save(), o.own_constants ? dem::Constants::own : dem::Constants::from_text);
  }
  const auto compare_at = o.compare ? comparison_steps(job.steps) : std::vector<std::uint64_t>();
  std::vector<Divergence> divergence;
  Series series(*engine);
  series.add(*engine);
  const InterruptGuard guard;
  Progress progress(fmt::format("{} {}", job.loaded.scene.name, token));
  const std::uint64_t most = std::max<std::uint64_t>(1, job.steps / 200);
  auto next_compare = compare_at.begin();
  while (engine->iteration() < job.steps && !interrupted()) {
    const std::uint64_t now = engine->iteration();
    if (!out.empty() && std::ranges::count(job.snapshot_steps, now) != 0)
      write_picture(o, out, job, token, *engine);
    std::uint64_t until = std::min(job.steps, now + most);
    if (job.record_every != 0) until = std::min(until, (now / job.record_every + 1) * job.record_every);
    if (next_compare != compare_at.end()) until = std::min(until, *next_compare);
    for (const auto s : job.snapshot_steps) {
      if (s > now) until = std::min(until, s);
    }
    if (now == 0) until = 1;
    engine->step(until - now);
    if (reference) reference->step(until - now);
    if (until == 1 || until == job.steps || (job.record_every != 0 && until % job.record_every == 0))
      series.add(*engine);
    if (next_compare != compare_at.end() && until == *next_compare) {
      divergence.push_back(compare_engines(*engine, *reference, type_or_fail(token).descriptor().format));
      ++next_compare;
    }
    progress.update(static_cast<double>(until), static_cast<double>(job.steps));
  }
  const bool complete = engine->iteration() == job.steps;
  const std::string stem = fmt::format("{}_{}", job.loaded.scene.name, token);
  if (!out.empty()) {
    if (std::ranges::count(job.snapshot_steps, engine->iteration()) != 0)
      write_picture(o, out, job, token, *engine);
    make_directory(out / "series");
    if (o.record) write_file(out / "series" / (stem + ".csv"), series.csv());
    if (o.compare) write_file(out / "series" / ("divergence_" + stem + ".csv"), divergence_csv(divergence));
  }
  Json left_out = Json::array();
  for (const auto& part : engine->explain().left_out)
    left_out.push_back({{"part", part.part}, {"why", part.why}});
  Json j;
  j["scene"] = job.loaded.scene.name;
  j["type"] = token;
  j["integrator"] = "leapfrog";
  j["dt"] = job.loaded.scene.dt;
  j["variant"] = fmt::format("{}", fmt::join(o.overrides, ","));
  j["steps"] = engine->iteration();
  j["t_end"] = engine->time_s();
  j["bodies"] = engine->bodies();
  j["contacts"] = engine->contacts().size();
  j["threads"] = o.threads;
  j["parts_left_out"] = left_out;
  j["kinetic_energy"] = engine->kinetic_energy();
  j["mean_position"] = mean_position(*engine);
  j["energy"] = energy_json(*engine);
  j["energy_start"] = series.energy_start();
  j["max_energy_error"] = series.max_energy_error();
  j["state_hash"] = fmt::format("{:016x}", state_hash(*engine));
  j["memory_bytes"] = engine->memory_bytes();
  j["plan"] = job.plan;
  if (!o.json) {
    fmt::print(
        "{:<12} {:<16} steps {:>8}  t {:<10.6g} contacts {:>6}  kinetic {:.10g} J  mean y {:.10g} m  state "
        "{}\n",
        job.loaded.scene.name, token, engine->iteration(), engine->time_s(), engine->contacts().size(),
        engine->kinetic_energy(), mean_position(*engine)[1], j["state_hash"].get<std::string>());
    for (const auto& d : divergence) {
      fmt::print("  step {:>8}: position {:.3e} m = {:.4g} ULP, velocity {:.3e} m/s = {:.4g} ULP{}\n", d.step,
                 d.position_error_m, d.position_error_ulp, d.velocity_error_m_per_s, d.velocity_error_ulp,
                 d.only_tested.size() + d.only_reference.size() == 0
                     ? ""
                     : fmt::format(", contacts only here {}, only in RealHP<4> {}", d.only_tested.size(),
                                   d.only_reference.size()));
    }
  }
  return {j, complete};
}

// The paper's protocol: repeats from the start, each after one untimed step; points outside two standard
// deviations are dropped.
Json measure(const std::string& token, const Job& job, const SceneOptions& o) {
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

ExitCode run_bench(const Job& job, const SceneOptions& o, const std::vector<std::string>& types,
                   const std::filesystem::path& out) {
  std::vector<Json> rows;
  double of_double = 0;
  for (const auto& token : types) {
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

ExitCode run_scene(const SceneOptions& o) {
  let_waiting_threads_sleep(o.threads);
  const Job job = make_job(o);
  const auto types = select_types(o.types);
  const std::filesystem::path out = o.out;
  if (!o.out.empty()) make_directory(out);
  if (o.explain) {
    for (const auto& token : types) explain(token, job, o);
    return ExitCode::pass;
  }
  if (o.ladder) {
    ExitCode code = ExitCode::pass;
    for (const auto& token : types) code = std::max(code, ladder(token, job, o));
    return code;
  }
  if (o.out.empty() && (o.record || o.vtk || !o.snapshots.empty()))
    throw Failure(ExitCode::bad_input, "--record, --snapshots and --vtk need --out DIR");
  if (o.repeats != 0) return run_bench(job, o, types, out);
  std::string text;
  bool complete = true;
  for (const auto& token : types) {
    const Written written = run_one(token, job, o, out);
    complete = complete && written.complete;
    text += written.record.dump() + "\n";
    if (!complete) break;
  }
  if (o.json) fmt::print("{}", text);
  if (!o.out.empty()) {
    write_file(out / scene_records_file, text);
    const Json context =
        make_scene_context(job.plan, job.plan_text, types, static_cast<unsigned>(o.threads), complete);
    write_file(out / "context.json", context.dump(2) + "\n");
  }
  if (!complete)
    throw Failure(ExitCode::incomplete,
                  o.out.empty() ? "interrupted" : "interrupted; what was done is in " + o.out);
  return ExitCode::pass;
}

}  // namespace

void add_scene_command(CLI::App& app, Action& action) {
  auto* scene =
      app.add_subcommand("scene", "Run a DEM scene, explain it, compare it with RealHP<4>, time it");
  auto o = std::make_shared<SceneOptions>();
  scene->add_option("SCENE", o->name, "a scene built in (`ulpgate list scenes`) or a TOML file")->required();
  scene->add_option("--type,--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  scene->add_option("--set,--variant", o->overrides,
                    "key=value: dt, damping, mass=yade, a constant of the scene ...");
  scene->add_option("--dt", o->dt, "time step, s");
  scene->add_option("--until", o->until, "end, s");
  scene->add_option("--steps", o->steps, "number of steps, instead of --until");
  scene->add_option("--threads", o->threads, "threads; any number gives the same bytes")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  scene->add_flag("--all-parts", o->all_parts, "leave nothing out; the same bytes, slower");
  scene->add_flag("--explain", o->explain,
                  "print what the scene leaves out and the step time with and without");
  scene->add_flag("--compare", o->compare,
                  "run RealHP<4> from the same state beside it and report the divergence");
  scene->add_flag("--own-constants", o->own_constants,
                  "with --compare: RealHP<4> makes constants from the scene's text instead of widening them");
  scene->add_flag("--ladder", o->ladder, "name constants that are good to the digits of a double only");
  scene->add_flag("--record", o->record, "write series/<scene>_<type>.csv with the energy account");
  scene->add_option("--snapshots", o->snapshots, "times in s, comma-separated: write snapshots/*.csv");
  scene->add_flag("--vtk", o->vtk, "with --snapshots: write vtk/*.vtk for ParaView as well");
  scene->add_option("--repeats", o->repeats, "measure the speed: repeats of --steps from the start");
  scene->add_option("--out", o->out, "directory of the records");
  scene->add_flag("--json", o->json, "print the records");
  scene->callback([=, &action] { action = [=] { return run_scene(*o); }; });
}

}  // namespace ulpgate::app
