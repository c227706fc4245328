// OutputDirectory.
#include "harness/app/store/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

// Every run of the whole plan.
constexpr const char* whole = "0/1";
// Whatever a verb writes into its directory.
constexpr const char* records_files[] = {math_records_file,  kernel_records_file,
                                         scene_records_file, "correlation.jsonl",
                                         "orders.jsonl",     "drift.jsonl",
                                         "stress.jsonl",     "work_precision.jsonl",
                                         "collisions.jsonl", "work_precision_fits.jsonl"};
constexpr const char* other_entries[] = {timing_file,
                                         timing_repeats_file,
                                         "work_precision_timing.jsonl",
                                         "advice.json",
                                         "units",
                                         "checkpoints",
                                         "series",
                                         "trajectory",
                                         "snapshots",
                                         "vtk",
                                         "contacts",
                                         "correlation"};

Json json_of(const RunIdentity& identity) {
  return {{"format", 2},
          {"verb", identity.verb},
          {"plan", identity.plan},
          {"shards", identity.shards},
          {"selection", identity.selection},
          {"machine", identity.machine}};
}

// Names the first of the entries that differ, with both values.
std::string difference(const Json& there, const Json& here) {
  for (const auto& [key, value] : here.items()) {
    const Json other = there.contains(key) ? there.at(key) : Json(nullptr);
    if (other == value) continue;
    if (value.is_object() && other.is_object()) return key + " " + difference(other, value);
    return fmt::format("{} {}, not {}", key, other.dump(), value.dump());
  }
  return "entries that this program does not know";
}

// A text of the context; `absent` where there is none.
std::string text_at(const Json& context, const char* key, const std::string& absent) {
  const auto it = context.find(key);
  return it != context.end() && it->is_string() ? it->get<std::string>() : absent;
}

std::vector<std::string> shards_of(const Json& context) {
  std::vector<std::string> shards;
  const auto it = context.find("shards");
  if (it == context.end() || !it->is_array()) return {whole};
  for (const auto& shard : *it) shards.push_back(shard.is_string() ? shard.get<std::string>() : shard.dump());
  return shards;
}

// What of the records there this run would lose; empty where nothing.
std::string loss(const Json& there, const RunIdentity& here) {
  if (!there.is_object()) return "records whose context.json cannot be read";
  const std::string plan = text_at(there, "plan", "none");
  const std::string verb = text_at(there, "verb", here.verb);
  const std::string selection = text_at(there, "selection", here.selection);
  if (plan != here.plan) return fmt::format("the records of another plan ({})", plan);
  // Who has no verb adds a file of its own to what is there.
  if (here.verb.empty()) return "";
  if (verb != here.verb) return fmt::format("the records of another verb ({})", verb);
  if (selection != here.selection) return fmt::format("the records of another selection ({})", selection);
  if (here.shards == std::vector<std::string>{whole}) return "";
  for (const auto& shard : shards_of(there)) {
    if (std::ranges::find(here.shards, shard) == here.shards.end())
      return fmt::format("the records of another shard ({})", shard);
  }
  return "";
}

// What write_file() of a killed process left: NAME.PID-THREAD.part.
bool is_remnant(const std::filesystem::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  constexpr std::string_view ending = ".part";
  if (!name.ends_with(ending)) return false;
  std::string_view rest = std::string_view(name).substr(0, name.size() - ending.size());
  for (const char before : {'-', '.'}) {
    const std::size_t digits = rest.find_last_not_of("0123456789") + 1;
    if (digits == 0 || digits == rest.size() || rest[digits - 1] != before) return false;
    rest = rest.substr(0, digits - 1);
  }
  return !rest.empty();
}

}  // namespace

std::string identity_text(const RunIdentity& identity) {
  return json_of(identity).dump();
}

std::optional<std::string> identity_difference(const std::string& there, const RunIdentity& here) {
  const Json other = Json::parse(there, nullptr, false);
  if (other == json_of(here)) return std::nullopt;
  return other.is_object() ? difference(other, json_of(here)) : "no identity";
}

OutputDirectory::OutputDirectory(std::filesystem::path path, RunIdentity identity, PartialRun policy)
    : path_(std::move(path)), identity_(std::move(identity)), policy_(policy) {
  make_directory(path_);
  lock();
  try {
    guard();
    remove_remnants();
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

OutputDirectory::~OutputDirectory() {
  if (lock_ >= 0) ::close(lock_);
}

void OutputDirectory::lock() {
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A file system without locks gives other errors: there the user alone sees to it.
  if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(lock_);
  throw Failure(Standing::bad_input, fmt::format("another process works in {}", path_.string()));
}

void OutputDirectory::guard() const {
  const auto context = path_ / context_file;
  std::string lost;
  if (std::filesystem::exists(context)) {
    lost = loss(Json::parse(read_file(context), nullptr, false), identity_);
  } else {
    for (const auto* name : records_files)
      if (std::filesystem::exists(path_ / name)) lost = fmt::format("{} without a {}", name, context_file);
  }
  if (!lost.empty()) {
    if (policy_ == PartialRun::discard) return clear();
    throw Failure(Standing::another_plan,
                  fmt::format("{} holds {}; choose another --out or give --overwrite", path_.string(), lost));
  }
  const auto checkpoints = path_ / "checkpoints";
  const bool partial = std::filesystem::exists(units() / "done.txt") ||
                       std::filesystem::exists(units() / "log.txt") || std::filesystem::exists(checkpoints);
  if (!partial || policy_ == PartialRun::resume) return;
  if (policy_ == PartialRun::refuse) {
    throw Failure(Standing::bad_input,
                  fmt::format("{} holds a partial run: go on with --resume, or start anew with --overwrite",
                              path_.string()));
  }
  // The records of the same run stay until better ones take their place.
  std::filesystem::remove_all(units());
  std::filesystem::remove_all(checkpoints);
}

void OutputDirectory::remove_remnants() const {
  std::vector<std::filesystem::path> found;
  const auto look_at = [&](const auto& entries) {
    for (const auto& entry : entries)
      if (is_remnant(entry)) found.push_back(entry.path());
  };
  look_at(std::filesystem::directory_iterator(path_));
  for (const auto* name : other_entries) {
    if (const auto directory = path_ / name; std::filesystem::is_directory(directory))
      look_at(std::filesystem::recursive_directory_iterator(directory));
  }
  for (const auto& file : found) std::filesystem::remove(file);
}

void OutputDirectory::clear() const {
  // The context goes last: without it nobody would know whose the rest is.
  for (const auto* name : other_entries) std::filesystem::remove_all(path_ / name);
  for (const auto* name : records_files) std::filesystem::remove(path_ / name);
  std::filesystem::remove(path_ / context_file);
}

bool OutputDirectory::is_finished() const {
  const auto file = path_ / context_file;
  if (!std::filesystem::exists(file) || std::filesystem::exists(units())) return false;
  const Json context = Json::parse(read_file(file), nullptr, false);
  if (!context.is_object() || !context.contains("finished")) return false;
  return context["finished"] == true && shards_of(context) == identity_.shards &&
         loss(context, identity_).empty();
}

void OutputDirectory::write(const std::string& name, const std::string& content) const {
  write_file(path_ / name, content);
}

void OutputDirectory::write_context_of(Json context, bool finished, bool sealed) const {
  context["verb"] = identity_.verb;
  context["shards"] = identity_.shards;
  if (!identity_.selection.empty()) context["selection"] = identity_.selection;
  // A run that has only begun answers for no records: what lies there is of an earlier process.
  RecordTexts records;
  for (const auto* name : records_files)
    if (sealed && std::filesystem::exists(path_ / name)) records[name] = read_file(path_ / name);
  write_context(path_, std::move(context), finished, records);
}

void OutputDirectory::begin(Json context) const {
  context["complete"] = false;
  write_context_of(std::move(context), false, false);
}

void OutputDirectory::finish(Json context, bool finished) const {
  write_context_of(std::move(context), finished, true);
}

}  // namespace ulpgate::app
