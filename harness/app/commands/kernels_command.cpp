// ulpgate kernels: runs the DEM kernels over strata of states and writes records.
#include <fmt/format.h>

#include "harness/app/commands/commands.hpp"
#include "harness/app/run/plan_run.hpp"
#include "harness/app/terminal/help.hpp"
#include "harness/app/terminal/terminal.hpp"
#include "harness/core/kernels/kernel_audit.hpp"

namespace ulpgate::app {

namespace {

void print_unstable(const std::vector<RowRecord>& records) {
  std::size_t unstable = 0;
  for (const auto& r : records) {
    if (is_stable(r.summary)) continue;
    ++unstable;
    fmt::print(stderr, "ulpgate: unstable: {} {} {} {}: {:.3g} roundings beyond its condition\n", r.subject,
               r.part, r.type, r.stratum, r.summary.max_error_over_condition);
  }
  fmt::print(stderr, "ulpgate: {} of {} rows are unstable (error over {:g} times condition and roundoff)\n",
             unstable, records.size(), stability_limit);
}

Verdict run_audit() {
  constexpr std::uint64_t states = 16;
  const auto found = audit_kernels(audited_kernel_table(), states);
  for (const auto& hidden : found)
    show("{}: the double {} becomes a number of the kernel's type: good to 16 digits only\n", hidden.kernel,
         hidden.literal);
  show("{} kernels, {} hidden doubles\n", dem::all_kernels().size(), found.size());
  return found.empty() ? Standing::pass : Standing::regression;
}

}  // namespace

void add_kernels_command(CLI::App& app, Action& action) {
  auto* kernels = app.add_subcommand("kernels", "Evaluate DEM kernels and judge them against RealHP<4>");
  set_foot(*kernels,
           {"ulpgate kernels --kernels sphere_sphere --types float,double --samples 200 --out out/kernels",
            "ulpgate kernels --audit"});
  auto o = std::make_shared<PlanOptions>();
  auto audit = std::make_shared<bool>(false);
  o->kind = SubjectKind::kernel;
  o->samples = 1000;
  kernels->add_option("--kernels", o->subjects, "all or names, comma-separated")->capture_default_str();
  add_plan_options(*kernels, *o, "states of each stratum");
  kernels->add_flag("--audit", *audit, "name kernels that hold a double literal instead of measuring");
  kernels->callback([=, &action] {
    action = [=] {
      if (*audit) return run_audit();
      return run_and_write(Plan(request_of(*o), {}), *o, nullptr, [](const RunResult& result) {
        print_unstable(result.records);
        return Standing::pass;
      });
    };
  });
}

}  // namespace ulpgate::app
