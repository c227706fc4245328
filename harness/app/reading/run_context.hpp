// context.json of a run's directory: written with checksums, read strictly.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/app/reading/json_fields.hpp"

namespace ulpgate::app {

inline constexpr const char* context_file = "context.json";

// The texts of a directory's records by the names of their files.
using RecordTexts = std::map<std::string, std::string>;

// Writes DIR/context.json after the records: with `finished` (every unit of what the run took on was done),
// with `records_checksum`, the FNV-1a of each file's bytes, and with a checksum of the context itself as its
// last key, so that whoever reads the directory notices what was changed in it since.
void write_context(const std::filesystem::path& directory, Json context, bool finished,
                   const RecordTexts& records);

// Of DIR.  Throws a Failure of bad_input that names the file where it is no context: not JSON, a value of
// another type, a plan that is not the hash of its text, another checksum, "complete" without "finished".
[[nodiscard]] Json read_context(const std::filesystem::path& directory);

// DIR/FILE, which the context must name.  Throws a Failure: incomplete where the file is not there.
[[nodiscard]] std::string read_records_text(const std::filesystem::path& directory, const std::string& file);
// Throws a Failure of bad_input where `text` is not what the run wrote.  To be asked after the lines were
// looked at, whose refusals say more.
void check_records_text(const Json& context, const std::filesystem::path& directory, const std::string& file,
                        const std::string& text);

// A line of a file and where it stands ("DIR/math.jsonl:12").
struct PlacedLine {
  std::string place;
  std::string text;
};
// Throws a Failure of bad_input for an empty line and for a last one without its end.
[[nodiscard]] std::vector<PlacedLine> placed_lines(const std::filesystem::path& file,
                                                   const std::string& text);

}  // namespace ulpgate::app
