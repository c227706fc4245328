// ulpgate integrators: the order of every integrator, measured on exactly solved problems, or its energy
// drift.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "harness/app/commands/commands.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/orders/order_output.hpp"
#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/run/resume_options.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* orders_file = "orders.jsonl";
constexpr const char* drift_file = "drift.jsonl";
const std::string whole = Shard().text();

// Before the table, which is long.
void say_summary(const OrderVerdicts& verdicts) {
  const std::string line = fmt::format("ulpgate: integrators: {} rows judged, {} wrong, {} not measured",
                                       verdicts.judged, verdicts.wrong.size(), verdicts.refused.size());
  const Paint paint = verdicts.wrong.empty() && verdicts.refused.empty() ? Paint::good : Paint::bad;
  fmt::print(stderr, "{}\n", painted(paint, line, stderr));
}

// What a finished run comes to.
Verdict report(const OrderVerdicts& verdicts, const OrderOptions& o) {
  for (const auto& line : verdicts.wrong) {
    if (o.json) {
      fmt::print(stderr, "FAIL {}\n", line);
    } else {
      show("{} {}\n", painted(Paint::bad, "FAIL"), line);
    }
  }
  for (const auto& line : verdicts.refused) fmt::print(stderr, "ulpgate: not measured: {}\n", line);
  if (!verdicts.wrong.empty()) return Standing::regression;
  if (!verdicts.refused.empty()) return Standing::incomplete;
  if (verdicts.judged > 0) return Standing::pass;
  throw Failure(Standing::incomplete,
                "nothing measured: no integrator with an order of its own has six rungs that begin above the "
                "floor of rounding; more --most-steps or a type of more digits give them");
}

// The lines of what is complete, in the order of the plan.
std::string all_records(const OrderJob& job, const OrderOptions& o) {
  std::string text;
  for (std::size_t i = 0; i < job.rows.size(); ++i)
    if (job.measurements[i]->complete()) text += record_lines(job.rows[i], o);
  return text;
}

void print_table(const OrderJob& job, const OrderOptions& o) {
  for (std::size_t i = 0; i < job.rows.size(); ++i)
    if (job.measurements[i]->complete()) show("{}", table_line(job.rows[i], o));
}

Verdict look_again(const std::filesystem::path& out, const OrderOptions& o) {
  const Json context = read_context(out);
  const LineKind& lines = o.drift_units != 0 ? drift_lines : order_lines;
  static_cast<void>(read_rows(out, context, lines));
  fmt::print(stderr, "ulpgate: {} is complete already\n", out.string());
  const auto verdicts = verdicts_from_json(context.value("verdicts", Json()), (out / context_file).string());
  if (o.json) fmt::print("{}", read_file(out / lines.file));
  return report(verdicts, o);
}

Verdict run_integrators(const OrderOptions& o) {
  if (o.out.empty() && (o.resume || o.overwrite))
    throw Failure(Standing::bad_input, "--resume and --overwrite need --out DIR");
  const OrderJob job = make_order_job(o);
  const char* records = o.drift_units != 0 ? drift_file : orders_file;
  const unsigned threads = o.threads != 0 ? o.threads : std::max(1U, std::thread::hardware_concurrency());
  std::optional<OutputDirectory> out;
  std::unique_ptr<PieceLog> log;
  Json context;
  if (!o.out.empty()) {
    out.emplace(o.out, RunIdentity{"integrators", job.plan, {whole}, "", machine_facts()},
                partial_run(o.resume, o.overwrite));
    if (o.resume && out->is_finished()) return look_again(out->path(), o);
    context = make_scene_context(job.plan, job.plan_text, job.types, threads, false);
    log = std::make_unique<PieceLog>(*out);
    out->begin(context);
  }
  std::vector<std::string> names;
  for (const auto& row : job.rows)
    names.push_back(fmt::format("{} {} {}", row.integrator.name, row.problem, row.type));
  const bool complete =
      run_measurements({"integrators", job.measurements, names, job.costs}, threads, log.get());
  const std::string text = all_records(job, o);
  const OrderVerdicts verdicts = complete ? judge_rows(job, o) : OrderVerdicts();
  if (log) {
    out->write(records, text);
    context["complete"] = complete;
    context["verdicts"] = to_json(verdicts);
    out->finish(context, complete);
    if (complete) log->remove();
  }
  if (complete) say_summary(verdicts);
  if (o.json) {
    fmt::print("{}", text);
  } else {
    print_table(job, o);
  }
  if (complete) return report(verdicts, o);
  throw Failure(Standing::incomplete,
                log ? fmt::format("interrupted; what was done is in {}; --resume goes on", o.out)
                    : "interrupted; without --out nothing is kept");
}

std::string finite_and_not_negative(const std::string& text) {
  double x = 0;
  const bool good = CLI::detail::lexical_cast(text, x) && std::isfinite(x) && x >= 0;
  return good ? "" : "'" + text + "' is no finite number from 0 on";
}

}  // namespace

void add_integrators_command(CLI::App& app, Action& action) {
  auto* verb = app.add_subcommand(
      "integrators", "Measure the order or the energy drift of integrators on exactly solved problems");
  set_foot(*verb,
           {"ulpgate integrators --integrators forest_ruth,gauss4 --types double,long_double",
            "ulpgate integrators --integrators yoshida8 --problems kepler --drift 100 --out out/drift"});
  auto o = std::make_shared<OrderOptions>();
  verb->add_option("--integrators", o->integrators, "all or names (`ulpgate list integrators`)")
      ->capture_default_str();
  verb->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  verb->add_option("--problems", o->problems, "all, or of oscillator, pendulum, kepler, rigid_body")
      ->capture_default_str();
  verb->add_option("--most-steps", o->most_steps, "steps double from 1 up to this")
      ->capture_default_str()
      ->check(CLI::Range(8L, 1L << 24));
  verb->add_option("--tolerance", o->tolerance, "an order lower by more, and by 5 %, is a failure")
      ->capture_default_str()
      ->check(CLI::Validator(finite_and_not_negative, "NUMBER"));
  verb->add_option("--drift", o->drift_units,
                   "measure the energy error along that many units of time instead")
      ->check(CLI::Range(1L, 1L << 40));
  verb->add_option("--steps-per-unit", o->steps_per_unit,
                   "with --drift: steps in a unit of time; a power of two keeps the step exact")
      ->capture_default_str()
      ->check(CLI::Range(1L, 1L << 30));
  verb->add_option("--threads", o->threads, "threads, 0: one a core; any number gives the same bytes")
      ->capture_default_str()
      ->check(CLI::Range(0U, 4096U));
  verb->add_option("--out", o->out, "directory of orders.jsonl (drift.jsonl) and context.json");
  add_resume_options(*verb, o->resume, o->overwrite);
  verb->add_flag("--json", o->json, "print the records");
  verb->callback([=, &action] { action = [=] { return run_integrators(*o); }; });
}

}  // namespace ulpgate::app
