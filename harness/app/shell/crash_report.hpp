// Crash report: a fatal signal in a function under test names the row that it happened in and ends with exit
// code 4.
#pragma once

#include <string_view>

namespace ulpgate::app {

void install_crash_report();

// While alive, this thread works on the named row.
class CrashPlace {
 public:
  CrashPlace(std::string_view function, std::string_view type, std::string_view stratum);
  CrashPlace(const CrashPlace&) = delete;
  CrashPlace& operator=(const CrashPlace&) = delete;
  ~CrashPlace();
};

}  // namespace ulpgate::app
