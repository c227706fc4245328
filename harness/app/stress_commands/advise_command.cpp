// ulpgate advise: the cheapest type, integrator and step that meet an error.
#include <fmt/format.h>

#include <cmath>

#include "harness/app/advice/advice.hpp"
#include "harness/app/advice/work_precision_output.hpp"
#include "harness/app/advice/work_precision_records.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/context.hpp"
#include "harness/app/stress_commands/stress_commands.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* advice_file = "advice.json";
// Four months.
constexpr double most_time_s = 1e7;

std::string plan_text_of(const AdviceOptions& o) {
  std::string text = fmt::format(
      "ulpgate advise plan 2\n{} error {:a} time {:a} types {} integrators {} until {} along {}\n", o.name,
      o.error, o.time_s, o.types, o.integrators, o.until, o.along);
  for (const auto& set : o.overrides) text += "set " + set + "\n";
  return text;
}

void keep(const OutputDirectory& out, Json context, const Advice& advice, const Json& json) {
  const std::string plan = out.identity().plan;
  const auto rows = measured_rows(advice);
  out.write(advice_file, json.dump(2) + "\n");
  out.write(work_precision_file, row_lines(rows, plan));
  out.write(fits_file, fit_lines(rows, plan));
  out.write(times_file, timing_lines(rows, advice.times, plan));
  context["complete"] = true;
  out.finish(std::move(context), true);
}

Verdict run_advise(const AdviceOptions& o) {
  if (o.time_s > most_time_s) {
    // As an end is written.
    std::string end = fmt::format("{:g}", o.time_s);
    if (const auto plus = end.find("e+"); plus != std::string::npos) end.erase(plus + 1, 1);
    throw Failure(
        Standing::bad_input,
        fmt::format(
            "--time {}: it is how long the recommended run may take on this machine, at most {:.0f} s; "
            "the end of the case's own time is --until {}",
            end, most_time_s, end));
  }
  if (o.out.empty() && o.overwrite) throw Failure(Standing::bad_input, "--overwrite needs --out DIR");
  const auto advice_case = make_advice_case(o);
  std::optional<OutputDirectory> out;
  Json context;
  if (!o.out.empty()) {
    const std::string text = plan_text_of(o);
    const std::string plan = fmt::format("{:016x}", fnv1a(text));
    out.emplace(o.out, RunIdentity{"advise", plan, {Shard().text()}, "", machine_facts()},
                partial_run(false, o.overwrite));
    context = make_scene_context(plan, text, select_types(o.types), 1, false);
    out->begin(context);
  }
  const Advice advice = advise(*advice_case, o);
  const Json json = advice_json(advice, *advice_case, o);
  if (out) keep(*out, context, advice, json);
  if (o.json) {
    fmt::print("{}\n", json.dump());
  } else {
    print_advice(advice, *advice_case, o);
  }
  if (advice.best) return Standing::pass;
  throw Failure(
      Standing::incomplete,
      fmt::format("no setting meets {:g} within {:g} s a run and {:g} s of search{}", o.error, o.time_s,
                  o.search_s, advice.nearest ? "; the nearest is limited by " + advice.limit : ""));
}

std::string positive_and_finite(const std::string& text) {
  double x = 0;
  const bool good = CLI::detail::lexical_cast(text, x) && std::isfinite(x) && x > 0;
  return good ? "" : "'" + text + "' is no finite number above 0";
}

}  // namespace

void add_advise_command(CLI::App& app, Action& action) {
  auto* verb = app.add_subcommand("advise", "Find the cheapest type, integrator and step that meet an error");
  set_foot(
      *verb,
      {"ulpgate advise pendulum3 --error 1e-10 --until 0.1",
       "ulpgate advise robertson --error 1e-12 --types double,long_double,float128",
       "ulpgate advise robertson --until 1e11 --error 1e-8 --time 1"},
      "Errors are measured, never computed from an order.  Exit code 3 where no setting meets the error.");
  auto o = std::make_shared<AdviceOptions>();
  const CLI::Validator positive(positive_and_finite, "NUMBER");
  verb->add_option("SCENE|CASE", o->name, "a scene built in, a file of a scene, or an initial value problem")
      ->required();
  verb->add_option(
          "--error", o->error,
          "wanted, relative: of a problem's state at the end (stiff: of each component), of a scene's "
          "positions up to the end")
      ->required()
      ->check(positive);
  verb->add_option("--time", o->time_s, "the longest that the recommended run may take on this machine, s")
      ->capture_default_str()
      ->check(positive);
  verb->add_option("--search-seconds", o->search_s, "what all runs of the search may take together")
      ->capture_default_str()
      ->check(positive);
  verb->add_option("--types", o->types, "all or tokens, comma-separated")->capture_default_str();
  verb->add_option("--integrators", o->integrators, "all or names; those that do not apply are left out")
      ->capture_default_str();
  verb->add_option(
      "--until", o->until,
      "end: one of the problem's, or of a scene in s (without: at most 1 s and 2e6 steps of a body)");
  verb->add_flag(
      "--along", o->along,
      "the error of a problem is to be below the one wanted on the way too, where runs are compared; "
      "of a scene it is in any case");
  verb->add_option("--set", o->overrides, "key=value of a scene, again for another")->allow_extra_args(false);
  verb->add_option("--records", o->records, "a directory of work_precision.jsonl to take settings from");
  auto* out = verb->add_option("--out", o->out, "directory of advice.json and of the settings measured");
  verb->add_flag("--overwrite", o->overwrite, "write over the records of another plan")->needs(out);
  verb->add_flag("--json", o->json, "print the advice as JSON");
  verb->callback([=, &action] { action = [=] { return run_advise(*o); }; });
}

}  // namespace ulpgate::app
