// GateFinding: one thing that the gate has to say of a row, with all that an output may show of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ulpgate {

// What a row is of: every kind of record that the gate holds.
enum class RowKind { function, kernel, scene, order, drift, stress, work_precision };
inline constexpr std::size_t row_kind_count = 7;
[[nodiscard]] std::string_view to_string(RowKind kind);  // "work_precision"

enum class FindingKind {
  regression,
  other_results,  // within every limit, but not what the budget was made of
  another_plan,   // drawn with another seed or size than the budget
  missing_budget,
  missing_record,
  incomplete,
  lost_cases,  // a list whose worst error is far below its budget, or that is shorter
  could_lower,
};
inline constexpr std::size_t finding_kind_count = 8;
[[nodiscard]] std::string_view to_string(FindingKind kind);  // "lost_cases"

struct GateFinding {
  FindingKind kind;
  std::string type;
  std::string row;      // "sin", "ctan.re", "pendulum3 leapfrog dt=1e-5 steps=100"
  std::string message;  // what, measured and budget, in words
  double severity = 0;  // measured / budget; the worst come first
  // Arguments of a function or a state of a kernel, as exact texts.
  std::vector<std::string> at{};
  RowKind of = RowKind::function;
  std::string stratum{};  // of functions and kernels
  std::string what{};     // the figure: "maximum error in ULP"
  std::optional<double> measured{};
  std::optional<double> budget{};
  std::string got{};        // at these arguments, as exact texts or in words; empty where no record says
  std::string wanted{};     // the same of the exact value
  std::string reproduce{};  // a command that shows it
  std::string again{};      // one that measures the whole row again, where the first shows a point of it
  // Where the budget stands, or would: the file's name without ".toml", and its key in it.
  std::string budget_file{};
  std::string budget_key{};
};

// What findings are sorted by: the kind, then falling severity.
[[nodiscard]] std::pair<FindingKind, double> finding_rank(const GateFinding& finding);
// What is alike stays in its order.
void sort_findings(std::vector<GateFinding>& findings);

// A row that was held against a budget: what outputs count and draw.
struct JudgedRow {
  RowKind of = RowKind::function;
  std::string type;
  std::string row;
  std::string stratum;             // of functions and kernels
  std::string what;                // the figure: "max_ulp", "t_s"
  std::optional<double> measured;  // none: no number was measured
  std::optional<double> budget;    // none: no budget limits it
  // The largest measured / limit over all that the budget limits of it, of what may not fall limit /
  // measured: above 1 beyond it.
  std::optional<double> ratio;
};

// measured / limit, or limit / measured of a least value; 0 where both are 0, infinity beyond a limit of 0.
[[nodiscard]] double budget_ratio(double measured, double limit);

// A hexfloat as "0x1.8p+0 (1.5)": the text, exact, and 17 significant decimal digits.  Any other text stays
// as it is, an exact value in decimal too.
[[nodiscard]] std::string with_decimal(const std::string& text);

}  // namespace ulpgate
