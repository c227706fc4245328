// The verbs about functions, which a program of functions alone (ULPGATE_FUNCTIONS_ONLY) has too; each adds
// its subcommand and runs when it was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "harness/app/shell/action.hpp"

namespace ulpgate::app {

class Ranks;

// Something that `ulpgate list` shows: its name and what prints it, as JSON where `json`.
struct Listing {
  std::string name;
  std::function<void(bool json)> print;
};

// Functions, types and strata, and `more` of what this program knows.
void add_list_command(CLI::App& app, Action& action, std::vector<Listing> more = {});
// The ranks of an MPI job, asked for when the verb runs; nullptr where the process is alone.
using RanksOfJob = std::function<Ranks*()>;

void add_math_command(CLI::App& app, Action& action, const RanksOfJob& ranks = {});
void add_at_command(CLI::App& app, Action& action);
void add_search_command(CLI::App& app, Action& action);
void add_merge_command(CLI::App& app, Action& action);

}  // namespace ulpgate::app
