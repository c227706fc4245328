// ulpgate_kernel_main(): the program that an accuracy test of kernels is.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "harness/interface/kernel_run.hpp"
#include "harness/interface/last_error.hpp"

namespace ulpgate::kernel_test {

namespace {

using Json = nlohmann::ordered_json;
constexpr int passed = 0;
constexpr int above = 1;
constexpr int bad_usage = 2;
constexpr int io_failure = 4;
// CTest's SKIP_RETURN_CODE of ulpgate_add_accuracy_test().
constexpr int skipped = 77;

struct Options {
  std::string kernel;
  std::string type;
  std::uint64_t samples = 2000;
  std::uint64_t seed = 1;
  double max_ulp = -1;  // below 0: none
  std::string budget;
  std::string records;
  std::vector<std::string> at;
  bool update = false;
  bool extremes = false;
};

struct IoFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string part_name(const ulpgate_kernel& k, int part) {
  return k.results == 1 ? std::string("value") : fmt::format("part {}", part + 1);
}
std::string key_of(const ulpgate_kernel& k, int part) {
  return fmt::format("{} {} {}", k.name, k.type, part_name(k, part));
}

std::string hex_words(const ulpgate_kernel& k, const std::vector<long double>& args) {
  std::string text;
  for (const long double x : args) text += (text.empty() ? "" : " ") + hexfloat(k, x);
  return text;
}

std::string reproducer(const std::string& program, const ulpgate_kernel& k,
                       const std::vector<long double>& args) {
  return fmt::format("{} --kernel {} --type '{}' --at {}", program, k.name, k.type, hex_words(k, args));
}

// The largest of all strata of one part.
struct Worst {
  const ulpgate_kernel* kernel;
  int part;
  const PartRow* row = nullptr;  // null: nothing could be judged
  std::uint64_t samples = 0;
  std::vector<const PartRow*> mismatching;
};

std::vector<Worst> worst_of(const ulpgate_kernel& k, const std::vector<PartRow>& rows) {
  std::vector<Worst> all;
  for (int part = 0; part < k.results; ++part) {
    Worst w{&k, part, nullptr, 0, {}};
    for (const auto& row : rows) {
      if (row.part != part) continue;
      w.samples += row.samples;
      if (row.largest_ulp >= 0 && (w.row == nullptr || row.largest_ulp > w.row->largest_ulp)) w.row = &row;
      if (!row.mismatches.empty()) w.mismatching.push_back(&row);
    }
    all.push_back(w);
  }
  return all;
}

std::map<std::string, double> read_budget(const std::string& file) {
  try {
    std::map<std::string, double> limits;
    const toml::table table = toml::parse_file(file);
    const auto* rows = table["max_ulp"].as_table();
    if (rows == nullptr) throw std::invalid_argument(fmt::format("{}: no table [max_ulp]", file));
    for (const auto& [key, node] : *rows) {
      const double limit = node.value_or(-1.0);
      if (!(limit >= 0))
        throw std::invalid_argument(
            fmt::format("{}:{}: '{}' must be a number from 0 on", file, node.source().begin.line, key.str()));
      limits[std::string(key.str())] = limit;
    }
    return limits;
  } catch (const toml::parse_error& e) {
    throw std::invalid_argument(fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
  }
}

void write_file(const std::string& file, const std::string& text) {
  const std::string aside = file + ".part";
  {
    std::ofstream out(aside, std::ios::binary);
    out << text;
    out.flush();
    if (!out) throw IoFailure(fmt::format("{}: cannot be written", file));
  }
  std::error_code error;
  std::filesystem::rename(aside, file, error);
  if (error) throw IoFailure(fmt::format("{}: {}", file, error.message()));
}

// Two digits, rounded up, so that the next run is within it.
double rounded_up(double ulp) {
  if (!(ulp > 0)) return 0;
  const double unit = std::pow(10, std::floor(std::log10(ulp)) - 1);
  return std::ceil(ulp / unit) * unit;
}

void write_budget(const std::string& file, const std::vector<Worst>& worst) {
  std::string text =
      "# The largest errors in ULP of each kernel, type and part; written by --budget FILE "
      "--update.\n[max_ulp]\n";
  for (const auto& w : worst)
    if (w.row != nullptr)
      text += fmt::format("\"{}\" = {:#.6g}\n", key_of(*w.kernel, w.part), rounded_up(w.row->largest_ulp));
  write_file(file, text);
}

Json json_of(const ulpgate_kernel& k, const PartRow& row, const Options& o) {
  Json args = Json::array();
  for (const long double x : row.args) args.push_back(hexfloat(k, x));
  Json first = Json::object();
  for (const auto& [name, x] : row.mismatch_args) {
    first[name] = Json::array();
    for (const long double a : x) first[name].push_back(hexfloat(k, a));
  }
  return {{"kernel", k.name},
          {"type", k.type},
          {"part", part_name(k, row.part)},
          {"stratum", row.stratum},
          {"samples", row.samples},
          {"seed", o.seed},
          {"max_ulp", row.largest_ulp < 0 ? Json(nullptr) : Json(row.largest_ulp)},
          {"mean_ulp", row.mean_ulp},
          {"argmax", args},
          {"mismatch", row.mismatches},
          {"mismatch_first", first}};
}

void print_point(const ulpgate_kernel& k, const std::vector<long double>& args) {
  const auto parts = look_at(k, args);
  fmt::print("{} {}\n", k.name, k.type);
  for (int i = 0; i < k.arguments; ++i)
    fmt::print("  {:<16} {}\n", k.argument_names[i], hexfloat(k, args[static_cast<std::size_t>(i)]));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const PartAt& at = parts[p];
    if (parts.size() > 1) fmt::print(" part {}\n", p + 1);
    fmt::print("  value            {}  ({})\n  exact value      {}\n", at.got, at.decimal, at.exact);
    if (at.judgement.outcome == Outcome::finite) {
      fmt::print("  ULP error        {:.6g}\n", at.judgement.error.value);
    } else {
      fmt::print("  outcome          {}\n", name_of(at.judgement.outcome));
    }
    fmt::print("  condition number {:.6g}: half an ULP in the arguments costs up to so many ULP\n",
               at.condition);
  }
}

class Program {
 public:
  Program(std::string name, Options o, const ulpgate_kernel* kernels, std::size_t count)
      : name_(std::move(name)), o_(std::move(o)) {
    for (std::size_t i = 0; i < count; ++i) {
      const ulpgate_kernel& k = kernels[i];
      if ((o_.kernel.empty() || o_.kernel == k.name) && (o_.type.empty() || o_.type == k.type))
        kernels_.push_back(&k);
    }
    if (kernels_.empty()) throw std::invalid_argument("no kernel of that name and type");
  }

  int run() {
    if (!o_.at.empty()) return look();
    std::vector<std::vector<PartRow>> rows;
    std::vector<Worst> worst;
    rows.reserve(kernels_.size());
    for (const auto* k : kernels_) {
      rows.push_back(run_kernel(*k, o_.samples, o_.seed, o_.extremes));
      for (auto& w : worst_of(*k, rows.back())) worst.push_back(w);
    }
    if (!o_.records.empty()) write_records(rows);
    if (std::ranges::all_of(worst,
                            [](const Worst& w) { return w.row == nullptr && w.mismatching.empty(); })) {
      fmt::print(stderr, "{}: nothing measured\n", name_);
      return skipped;
    }
    if (o_.update) {
      if (o_.budget.empty()) throw std::invalid_argument("--update without --budget FILE");
      write_budget(o_.budget, worst);
    }
    return judge_all(worst);
  }

 private:
  int look() {
    const ulpgate_kernel& k = *kernels_.front();
    if (o_.at.size() != static_cast<std::size_t>(k.arguments))
      throw std::invalid_argument(
          fmt::format("{} takes {} arguments, found {}", k.name, k.arguments, o_.at.size()));
    std::vector<long double> args;
    for (const auto& text : o_.at) args.push_back(parse_number(k, text));
    print_point(k, args);
    return passed;
  }

  void write_records(const std::vector<std::vector<PartRow>>& rows) const {
    std::string text;
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto& row : rows[i]) text += json_of(*kernels_[i], row, o_).dump() + "\n";
    write_file(o_.records, text);
  }

  int judge_all(const std::vector<Worst>& worst) const {
    const auto budget = o_.budget.empty() ? std::map<std::string, double>{} : read_budget(o_.budget);
    fmt::print("{:<20} {:<12} {:<8} {:>9} {:>12} {:>10} {:>9} {:<8} {}\n", "kernel", "type", "part",
               "samples", "max ULP", "limit", "condition", "stratum", "argument");
    int code = passed;
    for (const auto& w : worst) {
      const ulpgate_kernel& k = *w.kernel;
      std::optional<double> limit;
      if (o_.max_ulp >= 0) limit = o_.max_ulp;
      if (const auto it = budget.find(key_of(k, w.part)); it != budget.end()) limit = it->second;
      if (!o_.budget.empty() && !limit) {
        fmt::print(stderr, "{}: {} has no row for '{}' (--update writes it)\n", name_, o_.budget,
                   key_of(k, w.part));
        code = above;
      }
      if (w.row != nullptr) {
        const double condition = look_at(k, w.row->args)[static_cast<std::size_t>(w.part)].condition;
        fmt::print("{:<20} {:<12} {:<8} {:>9} {:>12.6g} {:>10} {:>9.3g} {:<8} {}\n", k.name, k.type,
                   part_name(k, w.part), w.samples, w.row->largest_ulp,
                   limit ? fmt::format("{:g}", *limit) : "-", condition, w.row->stratum,
                   hex_words(k, w.row->args));
      }
      if (limit && w.row != nullptr && !(w.row->largest_ulp <= *limit)) {
        code = above;
        fmt::print("FAILED: {} {}: {:.6g} ULP, limit {:g}\n  {}\n", k.name, k.type, w.row->largest_ulp,
                   *limit, reproducer(name_, k, w.row->args));
      }
      for (const auto* row : w.mismatching) code = std::max(code, show_mismatches(k, *row));
    }
    return code;
  }

  // A result of the wrong kind is above any limit.
  int show_mismatches(const ulpgate_kernel& k, const PartRow& row) const {
    for (const auto& [what, n] : row.mismatches) {
      fmt::print("FAILED: {} {} {}: {} at {} of {} points of {}\n  {}\n", k.name, k.type,
                 part_name(k, row.part), what, n, row.samples, row.stratum,
                 reproducer(name_, k, row.mismatch_args.at(what)));
    }
    return above;
  }

  std::string name_;
  Options o_;
  std::vector<const ulpgate_kernel*> kernels_;
};

int run(int argc, char** argv, const ulpgate_kernel* kernels, std::size_t count) {
  const std::string name = argc > 0 ? argv[0] : "accuracy-test";
  CLI::App app("Holds kernels to their values in four times the precision.", name);
  Options o;
  app.add_option("--kernel", o.kernel, "this one alone");
  app.add_option("--type", o.type, "this type alone: float, double, long double");
  app.add_option("--samples", o.samples, "points of each drawn stratum")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000000));
  app.add_option("--seed", o.seed, "seed of what is drawn")->capture_default_str();
  app.add_flag("--extremes", o.extremes, "also the smallest and largest numbers, subnormal ones among them");
  app.add_option("--max-ulp", o.max_ulp, "the largest error that passes")->check(CLI::Range(0.0, 1e300));
  app.add_option("--budget", o.budget, "TOML file of such limits, a row for each kernel, type and part");
  app.add_flag("--update", o.update, "write the budget from what is measured now");
  app.add_option("--records", o.records, "file for the records, a JSON object a line");
  app.add_option("--at", o.at, "one point, the last option: everything known about it")->expected(1, 64);
  app.footer(
      "Exit codes: 0 passed, 1 above a limit or a result of the wrong kind, 2 bad usage, 4 I/O, 77 nothing "
      "could be measured.");
  // Numbers may begin with a minus, and -inf is no option.
  int words = argc;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) != "--at") continue;
    words = i;
    for (int j = i + 1; j < argc; ++j) o.at.emplace_back(argv[j]);
    if (o.at.empty()) throw std::invalid_argument("--at without numbers");
    break;
  }
  try {
    app.parse(words, argv);
  } catch (const CLI::ParseError& e) {
    const int code = app.exit(e);
    return code == 0 ? passed : bad_usage;
  }
  return Program(name, std::move(o), kernels, count).run();
}

}  // namespace
}  // namespace ulpgate::kernel_test

extern "C" int ulpgate_kernel_main(int argc, char** argv, const struct ulpgate_kernel* kernels,
                                   size_t count) {
  using namespace ulpgate::kernel_test;
  try {
    return run(argc, argv, kernels, count);
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "{}: {}\n", argc > 0 ? argv[0] : "accuracy-test", e.what());
    return bad_usage;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}: {}\n", argc > 0 ? argv[0] : "accuracy-test", e.what());
    return io_failure;
  }
}
