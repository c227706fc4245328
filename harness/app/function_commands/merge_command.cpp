// ulpgate merge: joins the records of shards into those of the whole run, byte for byte.
#include <fmt/format.h>

#include <map>
#include <set>

#include "harness/app/function_commands/function_commands.hpp"
#include "harness/app/machine/machine_facts.hpp"
#include "harness/app/reading/planned_rows.hpp"
#include "harness/app/run/record_verdicts.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/output_directory.hpp"
#include "harness/app/terminal/help.hpp"

namespace ulpgate::app {

namespace {

// Another processor or library may give other last bits than one process would: refused, or said and written
// down where that is asked for.
Json other_machine(const std::string& directory, const Json& here, const std::string& first,
                   const Json& there, bool allowed) {
  Json noted = Json::array();
  for (const auto& difference : machine_differences(here, there)) {
    const std::string text =
        fmt::format("{} was run with another machine or library than {}: {}", directory, first, difference);
    if (!allowed) {
      throw Failure(Standing::another_machine,
                    text + "; the bytes need not be those of one process (--allow-other-machine merges)");
    }
    fmt::print(stderr, "ulpgate: note: {}; the bytes need not be those of one process\n", text);
    noted.push_back(text);
  }
  return noted;
}

// The parts of one run, joined as they are read.
class Joined {
 public:
  explicit Joined(bool other_machines) : other_machines_(other_machines) {}

  void add(const std::string& directory) {
    RecordSet set = read_records(directory);
    if (first_.empty()) {
      first_ = directory;
      context_ = set.context;
      file_ = set.file;
    }
    // What was planned follows from the plan but for the worst cases, of which that has a checksum alone.
    for (const auto* key : {"plan", "planned"}) {
      if (set.context.at(key) == context_.at(key)) continue;
      throw Failure(
          Standing::another_plan,
          fmt::format("{}: '{}' is not that of {} (plan {}, there {})", directory, key, first_,
                      set.context.at("plan").get<std::string>(), context_.at("plan").get<std::string>()));
    }
    for (const auto& text : other_machine(directory, set.context, first_, context_, other_machines_))
      context_["other_machines"].push_back(text);
    for (const std::string shard : set.context.at("shards")) take_shard(directory, shard);
    if (!set.context.at("finished").get<bool>()) unfinished_.push_back(directory);
    for (auto& r : set.records) take_record(directory, std::move(r));
  }

  // Writes what is there, all of the run or not.
  Verdict write(const std::string& out, bool overwrite) {
    std::vector<RowRecord> records;
    for (auto& [key, r] : rows_) records.push_back(std::move(r));
    context_["shards"] = shards_;
    const bool finished = unfinished_.empty();
    const std::vector<std::string> missing = missing_shards();
    context_["complete"] = finished && missing.empty();
    std::vector<std::string> places(records.size(), "merged");
    const auto absent = absent_rows(context_, "merged", records, places);
    const std::string text = records_text(records);
    const std::vector<std::string> shards(shards_.begin(), shards_.end());
    const OutputDirectory directory(
        out, {context_.value("verb", ""), context_.at("plan"), shards, context_.value("selection", ""), {}},
        partial_run(false, overwrite));
    directory.write(file_, text);
    directory.finish(context_, finished);
    const auto tell = [&](const std::string& what, const std::vector<std::string>& names) {
      if (!names.empty())
        fmt::print(stderr, "ulpgate: merged into {}, but {}: {}\n", out, what, some_of(names));
    };
    tell("an interrupted run is not all of its shard", unfinished_);
    tell(fmt::format("{} of {} shards are there; missing", shards_.size(), shard_count_), missing);
    tell("rows are absent", absent);
    Verdict verdict = file_ == math_records_file ? oracle_verdict(records) : Verdict();
    verdict |= claim_verdict(records);
    if (!finished || !missing.empty() || !absent.empty()) verdict.add(Standing::incomplete);
    if (records.empty()) verdict.add(Standing::nothing_measured);
    if (verdict.count(Standing::incomplete) == 0)
      fmt::print(stderr, "ulpgate: {} shards merged into {}\n", shards_.size(), out);
    return verdict;
  }

 private:
  void take_shard(const std::string& directory, const std::string& text) {
    const Shard shard = parse_shard(text);
    if (shard_count_ == 0) shard_count_ = shard.count;
    if (shard.count != shard_count_) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: shard {} does not divide the run as the others do (n = {})", directory,
                                text, shard_count_));
    }
    if (!shards_.insert(text).second)
      throw Failure(Standing::bad_input, fmt::format("{}: shard {} is there twice", directory, text));
  }

  void take_record(const std::string& directory, RowRecord r) {
    const std::string key = fmt::format("{} {} {} {}", r.subject, r.part, r.type, r.stratum);
    const auto found = rows_.find(key);
    if (found == rows_.end()) {
      rows_.emplace(key, std::move(r));
      return;
    }
    if (r.implementation != found->second.implementation) {
      throw Failure(
          Standing::bad_input,
          fmt::format("{}: {} was measured with {}, in other shards with {}: two codes are no one row",
                      directory, key, r.implementation, found->second.implementation));
    }
    merge_record(found->second, r);
  }

  [[nodiscard]] std::vector<std::string> missing_shards() const {
    std::vector<std::string> missing;
    // Of very many shards the first few that are missing are enough to name.
    constexpr std::size_t most = 1000;
    for (std::uint64_t i = 0; i < shard_count_ && missing.size() < most; ++i) {
      std::string name = Shard{i, shard_count_}.text();
      if (!shards_.contains(name)) missing.push_back(std::move(name));
    }
    return missing;
  }

  bool other_machines_;
  std::string first_;
  Json context_;
  std::string file_;
  std::uint64_t shard_count_ = 0;
  std::set<std::string> shards_;
  std::map<std::string, RowRecord> rows_;
  std::vector<std::string> unfinished_;
};

Verdict run_merge(const std::vector<std::string>& directories, const std::string& out, bool other_machines,
                  bool overwrite) {
  Joined joined(other_machines);
  for (const auto& directory : directories) {
    std::error_code code;
    if (std::filesystem::equivalent(directory, out, code))
      throw Failure(Standing::bad_input, fmt::format("--out {} is one of the shards", out));
    joined.add(directory);
  }
  return joined.write(out, overwrite);
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  auto* merge = app.add_subcommand("merge", "Join the records of shards");
  set_foot(*merge, {"ulpgate math --functions exp --types double --samples 2000 --shard 1/2 --out out/half1 "
                    "&& ulpgate merge out/half0 out/half1 --out out/whole",
                    "ulpgate merge out/half0 out/half1 --out out/whole --allow-other-machine --overwrite"});
  auto directories = std::make_shared<std::vector<std::string>>();
  auto out = std::make_shared<std::string>();
  merge->add_option("DIR", *directories, "directories of the shards")->required();
  merge->add_option("--out", *out, "directory of the joined records")->required();
  auto other_machines = std::make_shared<bool>(false);
  merge->add_flag("--allow-other-machine", *other_machines,
                  "merge shards that were run on different machines or libraries, and say so");
  auto overwrite = std::make_shared<bool>(false);
  merge->add_flag("--overwrite", *overwrite,
                  "write over the records of another plan, or other shards, in --out");
  merge->callback(
      [=, &action] { action = [=] { return run_merge(*directories, *out, *other_machines, *overwrite); }; });
}

}  // namespace ulpgate::app
