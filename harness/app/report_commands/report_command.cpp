// ulpgate report: starts the report program of reports/ with an interpreter that has what it needs.
#include "harness/app/report_commands/report_commands.hpp"
#include "harness/app/report_commands/report_program.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

namespace {

struct ReportOptions {
  std::vector<std::string> directories;
  std::string out;
  bool print = false;
  // Files and an earlier run that the page takes into account.
  std::string gate, before, history;
  std::vector<std::string> axes;  // "X,Y" each; the report program knows the names and refuses others
};

// The report program either writes or prints; both are two runs of it.
Verdict run_report(const ReportOptions& o) {
  std::vector<std::string> words = {find_python({"matplotlib", "numpy", "jinja2", "jsonschema"}),
                                    find_report_program("report.py").string()};
  words.insert(words.end(), o.directories.begin(), o.directories.end());
  std::vector<std::vector<std::string>> options;
  if (!o.out.empty()) {
    options.push_back({"--out", o.out});
    for (const auto& pair : o.axes) options.back().push_back("--axes=" + pair);
    for (const auto& [name, value] :
         {std::pair{"--gate=", &o.gate}, {"--before=", &o.before}, {"--history=", &o.history}})
      if (!value->empty()) options.back().push_back(name + *value);
  }
  if (o.print) options.push_back({"--print"});
  for (const auto& chosen : options) {
    std::vector<std::string> all = words;
    all.insert(all.end(), chosen.begin(), chosen.end());
    const int status = run_program(all);
    if (status != 0) return standing_of(status);
  }
  return Standing::pass;
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  auto* report = app.add_subcommand("report", "Make tables, figures and a page from records");
  set_foot(*report,
           {"ulpgate report out/sin --print", "ulpgate report out/sin --gate gate.json --out out/page"});
  auto o = std::make_shared<ReportOptions>();
  report
      ->add_option(
          "DIR", o->directories,
          "directory of the records; several: functions of libraries side by side, LABEL=DIR names one")
      ->required();
  auto* out = report->add_option("--out", o->out, "directory of the report");
  report->add_flag("--print", o->print, "print the ULP table");
  report
      ->add_option("--axes", o->axes,
                   "X,Y: draw error against run time with these axes, again for another pair; two of error, "
                   "largest_error, energy_error, seconds, steps, evaluations, dt (without: error,seconds)")
      ->allow_extra_args(false)
      ->needs(out);
  report
      ->add_option("--gate", o->gate,
                   "what `ulpgate gate DIR --json` printed: the page says first whether the run passed")
      ->needs(out);
  report
      ->add_option("--before", o->before,
                   "directory of an earlier run: the page says which rows are others now")
      ->needs(out);
  report->add_option("--history", o->history, "SQLite file of `ulpgate history`: trends and steps as well")
      ->needs(out);
  report->callback([=, &action] {
    action = [=] {
      if (o->out.empty() && !o->print)
        throw Failure(Standing::bad_input, "report: give --out DIR, --print or both");
      return run_report(*o);
    };
  });
}

}  // namespace ulpgate::app
