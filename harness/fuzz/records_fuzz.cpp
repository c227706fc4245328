// Fuzz target: lines of records and the context of a run; a line that is accepted comes back the same.
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "harness/app/reading/line_kinds.hpp"
#include "harness/app/reading/row_text.hpp"
#include "harness/app/reading/run_context.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/fuzz/scratch_directory.hpp"

namespace {

using namespace ulpgate::app;

void read_row(const std::string& line) {
  const auto record = from_json_line(line, "math.jsonl:1");
  const std::string written = to_json_line(record);
  if (to_json_line(from_json_line(written, "math.jsonl:1")) != written)
    throw std::logic_error("a record changes when it is written and read again");
}

void read_line(const LineKind& kind, const std::string& line) {
  const Json row = parse_object(line, "input:1");
  check_fields(row, kind.fields, UnknownKeys::refuse, "input:1");
  static_cast<void>(kind.contradiction(row));
}

// With the checksums that its bytes have, so that what is behind them is reached.
void read_run(const std::string& text) {
  static const ulpgate::fuzz::ScratchDirectory scratch;
  const Json context = parse_object(text, "input");
  scratch.write("scenes.jsonl", "");
  write_context(scratch.path(), context, true, {{"scenes.jsonl", ""}});
  static_cast<void>(read_scene_rows(scratch.path()));
}

}  // namespace

// The first character says what the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    switch (data[0]) {
      case 'm':
        read_row(text);
        break;
      case 's':
        read_line(scene_lines, text);
        break;
      case 'c':
        read_line(correlation_lines, text);
        break;
      case 'o':
        read_line(order_lines, text);
        break;
      case 'd':
        read_line(drift_lines, text);
        break;
      case 'r':
        read_run(text);
        break;
      default:
        break;
    }
  } catch (const Failure& e) {
    if (*e.what() == '\0') throw std::logic_error("an error without a text");
  }
  return 0;
}
