// History.
#include "harness/app/history/history_file.hpp"

#include <fmt/format.h>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// "ulpg": another program's SQLite file is nobody's history.
constexpr std::int64_t application = 0x756c7067;
constexpr std::int64_t schema_version = 1;

// The same figures of deterministic records stand once, however many runs have them.
constexpr const char* schema = R"sql(
CREATE TABLE platforms(id INTEGER PRIMARY KEY, facts TEXT NOT NULL UNIQUE);
CREATE TABLE runs(id INTEGER PRIMARY KEY, digest TEXT NOT NULL, commit_id TEXT NOT NULL, time_s INTEGER NOT NULL,
  platform INTEGER NOT NULL REFERENCES platforms, verb TEXT NOT NULL, plan TEXT NOT NULL, version TEXT NOT NULL,
  noise REAL NOT NULL, UNIQUE(digest, commit_id));
CREATE TABLE series(id INTEGER PRIMARY KEY, kind TEXT NOT NULL, name TEXT NOT NULL, part TEXT NOT NULL,
  type TEXT NOT NULL, setting TEXT NOT NULL, UNIQUE(name, type, kind, part, setting));
CREATE TABLE implementations(id INTEGER PRIMARY KEY, text TEXT NOT NULL UNIQUE);
CREATE TABLE results(id INTEGER PRIMARY KEY, kind TEXT NOT NULL, figures TEXT NOT NULL, error REAL,
  argument TEXT NOT NULL, mismatches INTEGER NOT NULL, UNIQUE(kind, figures));
CREATE TABLE measurements(run INTEGER NOT NULL REFERENCES runs, series INTEGER NOT NULL REFERENCES series,
  result INTEGER NOT NULL REFERENCES results, implementation INTEGER NOT NULL REFERENCES implementations,
  PRIMARY KEY(series, run)) WITHOUT ROWID;
CREATE TABLE times(run INTEGER NOT NULL REFERENCES runs, series INTEGER NOT NULL REFERENCES series,
  seconds TEXT NOT NULL, baseline_s TEXT NOT NULL, processes INTEGER NOT NULL, PRIMARY KEY(series, run)) WITHOUT ROWID;
CREATE TABLE steps(id INTEGER PRIMARY KEY, run INTEGER NOT NULL REFERENCES runs, before INTEGER NOT NULL REFERENCES runs,
  series INTEGER NOT NULL REFERENCES series, what TEXT NOT NULL, change TEXT NOT NULL, text TEXT NOT NULL,
  platform TEXT NOT NULL);
)sql";

Json json_of(const std::map<std::string, std::string>& facts) {
  Json j = Json::object();
  for (const auto& [name, value] : facts) j[name] = value;
  return j;
}

std::vector<double> numbers_in(const std::string& text) {
  const Json j = Json::parse(text, nullptr, false);
  std::vector<double> numbers;
  if (j.is_array())
    for (const auto& x : j)
      if (x.is_number()) numbers.push_back(x.get<double>());
  return numbers;
}

RowKey key_at(const Statement& row, int first) {
  return {row.text(first), row.text(first + 1), row.text(first + 2), row.text(first + 3),
          row.text(first + 4)};
}

// A query over the series that were chosen, in the order of the runs.
Statement chosen(Database& database, const std::string& columns, const std::string& table,
                 const RowChoice& choice) {
  return {database,
          fmt::format("SELECT {} FROM {} JOIN series ON series.id = series JOIN runs ON runs.id = run "
                      "WHERE {} ORDER BY series, time_s, run",
                      columns, table, choice.name.empty() ? "1" : "name = ?1 AND type = ?2")};
}

}  // namespace

HistoryFile::HistoryFile(const std::filesystem::path& file, Database::Access access)
    : database_(file, access), access_(access) {
  check_or_make();
  // What is read belongs together, whoever writes meanwhile.
  if (access_ == Database::Access::read) database_.run("BEGIN");
  read_runs();
}

void HistoryFile::check_or_make() {
  const auto hold = [&] {
    const std::int64_t owner = database_.pragma("application_id");
    const std::int64_t version = database_.pragma("user_version");
    if (owner != application) {
      Statement tables(database_, "SELECT count(*) FROM sqlite_master");
      const bool empty = owner == 0 && version == 0 && tables.next() && tables.integer(0) == 0;
      if (empty) return false;
      throw Failure(Standing::bad_input,
                    fmt::format("{}: an SQLite file, but no history of ulpgate", database_.file()));
    }
    if (version > schema_version) {
      throw Failure(Standing::bad_input,
                    fmt::format("{}: written by a newer ulpgate (format {}, this one knows {})",
                                database_.file(), version, schema_version));
    }
    return true;
  };
  // In one transaction: of a file that another process makes meanwhile all is seen, or nothing.
  database_.run("BEGIN");
  const bool held = hold();
  database_.run("COMMIT");
  if (held) return;
  if (access_ == Database::Access::read)
    throw Failure(Standing::bad_input,
                  fmt::format("{}: no history is there; --add DIR makes one", database_.file()));
  Transaction transaction(database_);
  // Another process may have made it since.
  if (hold()) return;
  database_.run(schema);
  database_.run(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application, schema_version)
          .c_str());
  transaction.commit();
}

void HistoryFile::read_runs() {
  runs_.clear();
  positions_.clear();
  Statement rows(
      database_,
      "SELECT runs.id, commit_id, time_s, facts, verb FROM runs JOIN platforms ON platforms.id = platform "
      "ORDER BY time_s, runs.id");
  while (rows.next()) {
    HistoryRun run{rows.integer(0), rows.text(1), rows.integer(2), {}, rows.text(4)};
    const Json facts = Json::parse(rows.text(3), nullptr, false);
    if (facts.is_object())
      for (const auto& [name, value] : facts.items())
        if (value.is_string()) run.platform[name] = value.get<std::string>();
    positions_[run.id] = runs_.size();
    runs_.push_back(std::move(run));
  }
}

std::int64_t HistoryFile::number_of(const char* select, const char* insert,
                                    const std::vector<std::string>& texts) {
  const auto bind_all = [&](Statement& statement) {
    for (std::size_t i = 0; i < texts.size(); ++i) statement.bind(static_cast<int>(i), texts[i]);
  };
  {
    Statement known(database_, select);
    bind_all(known);
    if (known.next()) return known.integer(0);
  }
  Statement fresh(database_, insert);
  bind_all(fresh);
  fresh.finish();
  return database_.last_row();
}

bool HistoryFile::add(const RunSummary& run, const std::string& commit, std::int64_t time_s) {
  // Another process may have added some before this one had the lock.
  read_runs();
  Statement known(database_, "SELECT id FROM runs WHERE digest = ?1 AND commit_id = ?2");
  known.bind(0, run.digest);
  known.bind(1, commit);
  if (known.next()) return false;
  const std::int64_t platform =
      number_of("SELECT id FROM platforms WHERE facts = ?1", "INSERT INTO platforms(facts) VALUES(?1)",
                {json_of(run.platform).dump()});
  Statement insert(database_,
                   "INSERT INTO runs(digest, commit_id, time_s, platform, verb, plan, version, noise) "
                   "VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
  insert.bind(0, run.digest);
  insert.bind(1, commit);
  insert.bind(2, time_s);
  insert.bind(3, platform);
  insert.bind(4, run.verb);
  insert.bind(5, run.plan);
  insert.bind(6, run.version);
  insert.bind(7, std::optional<double>(run.time_noise()));
  insert.finish();
  const std::int64_t id = database_.last_row();
  add_rows(id, run);
  add_times(id, run);
  read_runs();
  return true;
}

namespace {

constexpr const char* select_series =
    "SELECT id FROM series WHERE kind = ?1 AND name = ?2 AND part = ?3 AND type = ?4 AND setting = ?5";
constexpr const char* insert_series =
    "INSERT INTO series(kind, name, part, type, setting) VALUES(?1, ?2, ?3, ?4, ?5)";

std::vector<std::string> texts_of(const RowKey& key) {
  return {key.kind, key.name, key.part, key.type, key.setting};
}

}  // namespace

void HistoryFile::add_rows(std::int64_t id, const RunSummary& run) {
  Statement known(database_, "SELECT id FROM results WHERE kind = ?1 AND figures = ?2");
  Statement fresh(
      database_,
      "INSERT INTO results(kind, figures, error, argument, mismatches) VALUES(?1, ?2, ?3, ?4, ?5)");
  Statement insert(database_,
                   "INSERT INTO measurements(run, series, result, implementation) VALUES(?1, ?2, ?3, ?4)");
  const auto result_number = [&](const RowKey& key, const RowResult& result) {
    known.bind(0, key.kind);
    known.bind(1, result.figures);
    if (known.next()) {
      const std::int64_t number = known.integer(0);
      known.finish();
      return number;
    }
    fresh.bind(0, key.kind);
    fresh.bind(1, result.figures);
    fresh.bind(2, result.error);
    fresh.bind(3, result.argument);
    fresh.bind(4, static_cast<std::int64_t>(result.mismatches));
    fresh.finish();
    return database_.last_row();
  };
  for (const auto& [key, row] : run.rows) {
    insert.bind(0, id);
    insert.bind(1, number_of(select_series, insert_series, texts_of(key)));
    insert.bind(2, result_number(key, row.result));
    insert.bind(3, number_of("SELECT id FROM implementations WHERE text = ?1",
                             "INSERT INTO implementations(text) VALUES(?1)", {row.implementation}));
    insert.finish();
  }
}

void HistoryFile::add_times(std::int64_t id, const RunSummary& run) {
  Statement insert(
      database_, "INSERT INTO times(run, series, seconds, baseline_s, processes) VALUES(?1, ?2, ?3, ?4, ?5)");
  for (const auto& [key, row] : run.times) {
    insert.bind(0, id);
    insert.bind(1, number_of(select_series, insert_series, texts_of(key)));
    insert.bind(2, Json(row.seconds).dump());
    insert.bind(3, Json(row.baseline_s).dump());
    insert.bind(4, static_cast<std::int64_t>(row.processes));
    insert.finish();
  }
}

void HistoryFile::keep_steps(const std::vector<HistoryStep>& steps) {
  database_.run("DELETE FROM steps");
  Statement insert(database_,
                   "INSERT INTO steps(run, before, series, what, change, text, platform) "
                   "VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  for (const auto& step : steps) {
    insert.bind(0, runs_[step.run].id);
    insert.bind(1, runs_[step.before].id);
    insert.bind(2, number_of(select_series, insert_series, texts_of(step.key)));
    insert.bind(3, std::string_view(step.is_speed ? "speed" : "accuracy"));
    insert.bind(4, to_string(step.change));
    insert.bind(5, step.text);
    insert.bind(6, step.platform);
    insert.finish();
  }
}

std::map<RowKey, std::vector<RowPoint>> HistoryFile::rows(const RowChoice& choice) {
  Statement found =
      chosen(database_, "kind, name, part, type, setting, run, result, text",
             "measurements JOIN implementations ON implementations.id = implementation", choice);
  if (!choice.name.empty()) {
    found.bind(0, choice.name);
    found.bind(1, choice.type);
  }
  std::map<RowKey, std::vector<RowPoint>> rows;
  while (found.next())
    rows[key_at(found, 0)].push_back({positions_.at(found.integer(5)), found.integer(6), found.text(7)});
  return rows;
}

std::map<RowKey, std::vector<TimePoint>> HistoryFile::times(const RowChoice& choice) {
  Statement found = chosen(database_, "kind, name, part, type, setting, run, seconds, baseline_s, processes",
                           "times", choice);
  if (!choice.name.empty()) {
    found.bind(0, choice.name);
    found.bind(1, choice.type);
  }
  std::map<RowKey, std::vector<TimePoint>> rows;
  while (found.next()) {
    TimedRow times{numbers_in(found.text(6)), numbers_in(found.text(7)),
                   static_cast<std::size_t>(found.integer(8))};
    if (!times.seconds.empty())
      rows[key_at(found, 0)].push_back({positions_.at(found.integer(5)), std::move(times)});
  }
  return rows;
}

RowResult HistoryFile::result(std::int64_t id) {
  Statement found(database_, "SELECT kind, figures FROM results WHERE id = ?1");
  found.bind(0, id);
  if (!found.next())
    throw Failure(Standing::bad_input,
                  fmt::format("{}: a result is missing: the file is damaged", database_.file()));
  return result_of(find_row_kind(found.text(0)), found.text(1));
}

std::vector<std::string> HistoryFile::names() {
  Statement found(database_, "SELECT DISTINCT name FROM series ORDER BY name");
  std::vector<std::string> names;
  while (found.next()) names.push_back(found.text(0));
  return names;
}

}  // namespace ulpgate::app
