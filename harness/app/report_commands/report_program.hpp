// Programs of reports/, started with an interpreter that has what they need.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ulpgate::app {

// A Python that imports these modules (and "python3-NAME" of Debian has each): ULPGATE_PYTHON, else the first
// python3 on PATH, which may be one without them, else Debian's.  A Failure that names the packages where
// none does.
[[nodiscard]] std::string find_python(const std::vector<std::string>& modules);

// A program of reports/ beside the sources: found from this program upwards, or in the folder that
// ULPGATE_REPORTS names.
[[nodiscard]] std::filesystem::path find_report_program(std::string_view name);

// Runs a program and waits: its exit code, 128 and the signal that ended it, 127 where it cannot be started.
// It ends with this program, whatever ends that.
[[nodiscard]] int run_program(const std::vector<std::string>& words, bool silent = false);

}  // namespace ulpgate::app
