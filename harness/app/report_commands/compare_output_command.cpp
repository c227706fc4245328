// ulpgate compare-output: starts the program of reports/ that tells outputs of programs apart.
#include "harness/app/report_commands/report_commands.hpp"
#include "harness/app/report_commands/report_program.hpp"
#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// The options are the program's, which knows their names and refuses others.
Verdict run_compare_output(const std::vector<std::string>& words) {
  std::vector<std::string> all = {find_python({"numpy"}),
                                  find_report_program("compare_output_program.py").string()};
  all.insert(all.end(), words.begin(), words.end());
  const int status = run_program(all);
  return status == 0 ? Verdict(Standing::pass) : Verdict(standing_of(status));
}

}  // namespace

void add_compare_output_command(CLI::App& app, Action& action) {
  auto* compare = app.add_subcommand(
      "compare-output",
      "Outputs of two programs, field by field, and a wider third that tells whose error it is");
  compare->prefix_command();
  compare->set_help_flag();  // the program explains its options itself
  compare->callback([compare, &action] {
    const auto words = compare->remaining();
    action = [words] { return run_compare_output(words); };
  });
}

}  // namespace ulpgate::app
