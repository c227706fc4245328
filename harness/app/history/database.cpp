// Database.
#include "harness/app/history/database.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include "harness/app/shell/failure.hpp"

namespace ulpgate::app {

namespace {

// How long a writer waits for another one.
constexpr int patience_ms = 20000;

Standing standing_of_error(int code) {
  return code == SQLITE_NOTADB || code == SQLITE_CORRUPT ? Standing::bad_input : Standing::environment;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Access access) : file_(file.string()) {
  std::error_code code;
  const bool there = std::filesystem::exists(file, code);
  if (access == Access::read && !there && !code)
    throw Failure(Standing::bad_input, fmt::format("{}: no history is there; --add DIR makes one", file_));
  if (there && !std::filesystem::is_regular_file(file, code))
    throw Failure(Standing::bad_input, fmt::format("{}: not a file", file_));
  const int flags = SQLITE_OPEN_READWRITE | (access == Access::write ? SQLITE_OPEN_CREATE : 0);
  try {
    if (sqlite3_open_v2(file_.c_str(), &handle_, flags, nullptr) != SQLITE_OK) fail("cannot open");
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, patience_ms);
    run("PRAGMA foreign_keys = ON");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() {
  sqlite3_close(handle_);
}

void Database::fail(const char* what) const {
  const int code = handle_ == nullptr ? SQLITE_NOMEM : sqlite3_errcode(handle_) & 0xff;
  const char* words = handle_ == nullptr ? "out of memory" : sqlite3_errmsg(handle_);
  if (code == SQLITE_BUSY) {
    throw Failure(Standing::environment,
                  fmt::format("{}: {}: another process has been writing for {} s; nothing was changed", file_,
                              what, patience_ms / 1000));
  }
  throw Failure(standing_of_error(code), fmt::format("{}: {}: {}; nothing was changed", file_, what, words));
}

void Database::run(const char* sql) {
  if (sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr) != SQLITE_OK) fail("cannot write");
}

std::int64_t Database::last_row() const {
  return sqlite3_last_insert_rowid(handle_);
}

std::int64_t Database::pragma(const char* name) {
  Statement statement(*this, fmt::format("PRAGMA {}", name));
  return statement.next() ? statement.integer(0) : 0;
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  if (sqlite3_prepare_v2(database.handle_, sql.data(), static_cast<int>(sql.size()), &handle_, nullptr) !=
      SQLITE_OK)
    database_.fail("cannot read");
}

Statement::~Statement() {
  sqlite3_finalize(handle_);
}

void Statement::bind(int parameter, std::string_view text) {
  if (sqlite3_bind_text(handle_, parameter + 1, text.data(), static_cast<int>(text.size()),
                        SQLITE_TRANSIENT) != SQLITE_OK)
    database_.fail("cannot write");
}

void Statement::bind(int parameter, std::int64_t number) {
  if (sqlite3_bind_int64(handle_, parameter + 1, number) != SQLITE_OK) database_.fail("cannot write");
}

void Statement::bind(int parameter, const std::optional<double>& number) {
  const int code = number ? sqlite3_bind_double(handle_, parameter + 1, *number)
                          : sqlite3_bind_null(handle_, parameter + 1);
  if (code != SQLITE_OK) database_.fail("cannot write");
}

bool Statement::next() {
  const int code = sqlite3_step(handle_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE)
    database_.fail(sqlite3_stmt_readonly(handle_) != 0 ? "cannot read" : "cannot write");
  sqlite3_reset(handle_);
  return false;
}

void Statement::finish() {
  while (next()) {
  }
}

std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return bytes == nullptr
             ? ""
             : std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column)));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_, column);
}

std::optional<double> Statement::real(int column) const {
  if (sqlite3_column_type(handle_, column) == SQLITE_NULL) return std::nullopt;
  return sqlite3_column_double(handle_, column);
}

Transaction::Transaction(Database& database) : database_(database) {
  // The lock is taken at once: two writers that read first would both wait for the other's end.
  database_.run("BEGIN IMMEDIATE");
}

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const Failure&) {
    // SQLite rolled back itself: what failed has said why.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace ulpgate::app
