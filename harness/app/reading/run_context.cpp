// context.json of a run's directory.
#include "harness/app/reading/run_context.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/core/arguments/random_words.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* checksums_key = "records_checksum";
// Last in the file: all bytes before it are what it is of.
constexpr std::string_view own_checksum = ",\n  \"checksum\": \"";

std::string checksum(std::string_view text) {
  return fmt::format("{:016x}", fnv1a(text));
}

bool is_description(const Json& j) {
  return field::is_word(j) || field::is_object(j);
}
constexpr FieldKind description = {"a text or an object", is_description};

// Those that decide how records are read; what else stands there describes machine and subjects.
const std::vector<Field>& context_fields() {
  static const std::vector<Field> fields = {{"tool", field::object},
                                            {"compiler", description},
                                            {"libraries", field::object},
                                            {"cpu", description},
                                            {"plan", field::hash},
                                            {"plan_text", field::text},
                                            {"complete", field::flag},
                                            {"finished", field::flag},
                                            {checksums_key, field::object},
                                            {"checksum", field::hash},
                                            {"types", field::objects},
                                            {"seed", field::count, optional},
                                            {"samples", field::count, optional},
                                            {"strata", field::texts, optional},
                                            {"shards", field::texts, optional},
                                            {"threads", field::count, optional},
                                            {"planned", field::object, optional},
                                            {"functions", field::objects, optional},
                                            {"kernels", field::objects, optional},
                                            {"verdicts", field::object, optional}};
  return fields;
}

void check_shards(const Json& context, const std::string& place) {
  if (!context.contains("shards")) return;
  std::vector<std::string> seen;
  std::uint64_t count = 0;
  for (const std::string text : context.at("shards")) {
    Shard shard;
    try {
      shard = parse_shard(text);
    } catch (const Failure&) {
      throw Failure(Standing::bad_input, fmt::format("{}: '{}' in 'shards' is no shard", place, text));
    }
    if (!seen.empty() && shard.count != count)
      throw Failure(Standing::bad_input,
                    fmt::format("{}: shards of {} and of {}", place, count, shard.count));
    count = shard.count;
    if (std::ranges::find(seen, text) != seen.end())
      throw Failure(Standing::bad_input, fmt::format("{}: shard {} is there twice", place, text));
    seen.push_back(text);
  }
  if (seen.empty()) throw Failure(Standing::bad_input, fmt::format("{}: 'shards' names no shard", place));
  if (context.at("complete").get<bool>() && seen.size() != count) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: 'complete', but {} of {} shards are there", place, seen.size(), count));
  }
}

}  // namespace

void write_context(const std::filesystem::path& directory, Json context, bool finished,
                   const RecordTexts& records) {
  context.erase("checksum");
  context["finished"] = finished;
  Json checksums = Json::object();
  for (const auto& [file, text] : records) checksums[file] = checksum(text);
  context[checksums_key] = checksums;
  std::string text = context.dump(2);
  text.resize(text.rfind("\n}"));
  text += fmt::format("{}{}\"\n}}\n", own_checksum, checksum(text));
  write_file(directory / context_file, text);
}

Json read_context(const std::filesystem::path& directory) {
  const std::string place = (directory / context_file).string();
  const std::string text = read_file(directory / context_file);
  Json context = parse_object(text, place);
  check_fields(context, context_fields(), UnknownKeys::ignore, place);
  for (const auto& [file, sum] : context.at(checksums_key).items()) {
    if (!field::hash.accepts(sum)) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: '{}' of '{}' is not {}", place, checksums_key, file, field::hash.words));
    }
  }
  const std::string plan = context.at("plan");
  if (plan != checksum(context.at("plan_text").get_ref<const std::string&>()))
    throw Failure(Standing::bad_input, fmt::format("{}: plan {} is not that of 'plan_text'", place, plan));
  if (context.at("complete").get<bool>() && !context.at("finished").get<bool>())
    throw Failure(Standing::bad_input, fmt::format("{}: 'complete', but not 'finished'", place));
  check_shards(context, place);
  const std::size_t end = text.rfind(own_checksum);
  if (end == std::string::npos ||
      checksum(text.substr(0, end)) != context.at("checksum").get<std::string>() ||
      text.size() != end + own_checksum.size() + 16 + std::string_view("\"\n}\n").size()) {
    throw Failure(Standing::bad_input,
                  fmt::format("{}: not as the run wrote it: its checksum is another", place));
  }
  return context;
}

std::string read_records_text(const std::filesystem::path& directory, const std::string& file) {
  if (!std::filesystem::exists(directory / file)) {
    throw Failure(Standing::incomplete, fmt::format("{}: not there, though {} speaks of it",
                                                    (directory / file).string(), context_file));
  }
  return read_file(directory / file);
}

void check_records_text(const Json& context, const std::filesystem::path& directory, const std::string& file,
                        const std::string& text) {
  const Json& checksums = context.at(checksums_key);
  const auto it = checksums.find(file);
  if (it != checksums.end() && *it == checksum(text)) return;
  throw Failure(Standing::bad_input, fmt::format("{}: not as the run wrote it: its checksum is {}, {} has {}",
                                                 (directory / file).string(), checksum(text), context_file,
                                                 it == checksums.end() ? "none" : it->get<std::string>()));
}

std::vector<PlacedLine> placed_lines(const std::filesystem::path& file, const std::string& text) {
  std::vector<PlacedLine> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::string place = fmt::format("{}:{}", file.string(), lines.size() + 1);
    const std::size_t end = text.find('\n', at);
    if (end == std::string::npos)
      throw Failure(Standing::bad_input, fmt::format("{}: the line is torn: it has no end", place));
    if (end == at) throw Failure(Standing::bad_input, fmt::format("{}: an empty line", place));
    lines.push_back({place, text.substr(at, end - at)});
    at = end + 1;
  }
  return lines;
}

}  // namespace ulpgate::app
