// The foot of a help: examples, what there is to know beside the options, exit codes.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace ulpgate::app {

// What every exit code means.
[[nodiscard]] std::string exit_code_lines();

// Examples are whole commands; `harness/app/manual/examples_test.py` runs them, all in one folder, in the
// order of the verbs in `ulpgate --help`.
void set_foot(CLI::App& verb, const std::vector<std::string>& examples, const std::string& notes = "");

}  // namespace ulpgate::app
