// The foot of a help.
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

std::string exit_code_lines() {
  return "Exit codes: 0 pass, 1 accuracy regression, 2 bad usage or input, 3 nothing measured or "
         "incomplete,\n"
         "4 crash, time-out or I/O failure.";
}

void set_foot(CLI::App& verb, const std::vector<std::string>& examples, const std::string& notes) {
  std::string text = "Examples:\n";
  for (const auto& example : examples) text += "  " + example + "\n";
  if (!notes.empty()) text += notes + "\n";
  verb.footer(text + "\n" + exit_code_lines());
}

}  // namespace ulpgate::app
