// ulpgate merge: joins the records of shards into those of the whole run, byte for byte.
#include <fmt/format.h>

#include <map>
#include <set>

#include "harness/app/commands/commands.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

namespace {

// Another processor or library may give other last bits than one process would: said, not refused.
void note_other_machine(const std::string& directory, const Json& here, const std::string& first,
                        const Json& there) {
  for (const auto* key : {"tool", "compiler", "flags", "build_type", "libraries", "cpu"}) {
    const Json mine = here.value(key, Json());
    const Json theirs = there.value(key, Json());
    if (mine == theirs) continue;
    fmt::print(
        stderr,
        "ulpgate: note: {} was run with another {} than {}: {}, not {}; the bytes need not be those of "
        "one process\n",
        directory, key, first, mine.dump(), theirs.dump());
  }
}

ExitCode run_merge(const std::vector<std::string>& directories, const std::string& out) {
  std::map<std::string, RowRecord> rows;
  std::set<std::string> shards;
  Json context;
  std::string file;
  std::uint64_t shard_count = 0;
  for (const auto& directory : directories) {
    const RecordSet set = read_records(directory);
    if (context.is_null()) {
      context = set.context;
      file = set.file;
    }
    if (set.context.value("plan", "") != context.value("plan", "")) {
      throw Failure(ExitCode::bad_input, fmt::format("{}: plan {} is not that of {} ({})", directory,
                                                     set.context.value("plan", ""), directories.front(),
                                                     context.value("plan", "")));
    }
    note_other_machine(directory, set.context, directories.front(), context);
    for (const std::string shard : set.context.at("shards")) {
      const Shard s = parse_shard(shard);
      if (shard_count == 0) shard_count = s.count;
      if (s.count != shard_count) {
        throw Failure(ExitCode::bad_input,
                      fmt::format("{}: shard {} does not divide the run as the others do (n = {})", directory,
                                  shard, shard_count));
      }
      if (!shards.insert(shard).second) {
        throw Failure(ExitCode::bad_input, fmt::format("{}: shard {} is there twice", directory, shard));
      }
    }
    for (const auto& r : set.records) {
      const std::string key = fmt::format("{} {} {} {}", r.subject, r.part, r.type, r.stratum);
      const auto [it, fresh] = rows.try_emplace(key, r);
      if (fresh) continue;
      if (r.implementation != it->second.implementation) {
        throw Failure(
            ExitCode::bad_input,
            fmt::format("{}: {} was measured with {}, in other shards with {}: two codes are no one row",
                        directory, key, r.implementation, it->second.implementation));
      }
      merge_record(it->second, r);
    }
  }
  std::vector<RowRecord> records;
  bool complete = shards.size() == shard_count;
  for (auto& [key, r] : rows) {
    complete = complete && r.summary.samples == r.planned;
    records.push_back(std::move(r));
  }
  context["shards"] = std::vector<std::string>(shards.begin(), shards.end());
  context["complete"] = complete;
  context["finished"] = complete;
  make_directory(out);
  write_file(std::filesystem::path(out) / file, records_text(std::move(records)));
  write_file(std::filesystem::path(out) / "context.json", context.dump(2) + "\n");
  if (!complete) {
    throw Failure(ExitCode::incomplete,
                  fmt::format("merged into {}, but {} of {} shards are there or one was interrupted", out,
                              shards.size(), shard_count));
  }
  fmt::print(stderr, "ulpgate: {} shards merged into {}\n", shards.size(), out);
  return ExitCode::pass;
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  auto* merge = app.add_subcommand("merge", "Join the records of shards");
  auto directories = std::make_shared<std::vector<std::string>>();
  auto out = std::make_shared<std::string>();
  merge->add_option("DIR", *directories, "directories of the shards")->required();
  merge->add_option("--out", *out, "directory of the joined records")->required();
  merge->callback([=, &action] { action = [=] { return run_merge(*directories, *out); }; });
}

}  // namespace ulpgate::app
