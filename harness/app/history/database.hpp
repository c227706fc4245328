// Database: an SQLite file, its statements and transactions; every error names the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace ulpgate::app {

// Failures: environment for what the disk, its permissions or another process are to blame for, bad_input for
// a file that is no database.
class Database {
 public:
  enum class Access { read, write };
  // Access::write makes the file where there is none.
  Database(const std::filesystem::path& file, Access access);
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  ~Database();

  [[nodiscard]] const std::string& file() const { return file_; }
  // Statements without a result.
  void run(const char* sql);
  [[nodiscard]] std::int64_t last_row() const;
  [[nodiscard]] std::int64_t pragma(const char* name);
  // The Failure of what SQLite's last call on this file said.
  [[noreturn]] void fail(const char* what) const;

 private:
  friend class Statement;
  std::string file_;
  sqlite3* handle_ = nullptr;
};

// A statement; parameters and columns count from 0.
class Statement {
 public:
  Statement(Database& database, std::string_view sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  void bind(int parameter, std::string_view text);
  void bind(int parameter, std::int64_t number);
  void bind(int parameter, const std::optional<double>& number);
  // Whether there is one more row of the result; the statement can be bound anew after the last one.
  [[nodiscard]] bool next();
  // For what has no result.
  void finish();
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] std::optional<double> real(int column) const;

 private:
  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
};

// All of it or nothing: what was written is undone unless it was committed.  A writer waits for another one
// for as long as Database's patience lasts.
class Transaction {
 public:
  explicit Transaction(Database& database);
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction();
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

}  // namespace ulpgate::app
