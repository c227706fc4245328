// The options of a run that keeps what is finished: --resume and --overwrite.
#pragma once

#include <CLI/CLI.hpp>

namespace ulpgate::app {

inline void add_resume_options(CLI::App& verb, bool& resume, bool& overwrite) {
  auto* on =
      verb.add_flag("--resume", resume, "go on with a run that was interrupted or killed; a new one starts");
  verb.add_flag("--overwrite", overwrite, "write over the records of another plan, or a partial run")
      ->excludes(on);
}

}  // namespace ulpgate::app
