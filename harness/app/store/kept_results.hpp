// KeptResults: what is dear to compute and belongs to no record, kept under DIR/units while a run goes on.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/app/store/output_directory.hpp"

namespace ulpgate::app {

// A file for each result, written when it is whole, of lines with a checksum each.  What is torn, changed, of
// another run or of another result is named on stderr and computed again.  DIR/units goes with the end of the
// run.  Any thread may call both.
class KeptResults {
 public:
  // In a directory that this process owns.
  explicit KeptResults(const OutputDirectory& out);

  // `key` says all that the result depends on, besides the run's identity.
  [[nodiscard]] std::optional<std::vector<std::string>> find(const std::string& key) const;
  void keep(const std::string& key, const std::vector<std::string>& lines) const;

 private:
  [[nodiscard]] std::filesystem::path file_of(const std::string& key) const;

  std::filesystem::path directory_;
  std::string identity_;
};

}  // namespace ulpgate::app
