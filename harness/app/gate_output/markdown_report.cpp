// Markdown for the summary of a pipeline's step.
#include <fmt/format.h>

#include <algorithm>

#include "harness/app/gate_output/output_text.hpp"
#include "harness/app/gate_output/outputs.hpp"

namespace ulpgate::app {

namespace {

constexpr std::size_t most_findings = 20;
// GitHub refuses a step's summary above 1 MiB as a whole.
constexpr std::size_t most_bytes = 1000000;
// A state of a kernel in 500 bits is long; whoever wants all of it has the command.
constexpr std::size_t longest_text = 4000;

std::string shortened(const std::string& text) {
  if (text.size() <= longest_text) return text;
  // Of the first bytes of a text the last character may be torn.
  return valid_utf8(text.substr(0, longest_text)) + " ...";
}

// Text between cells and lines: nothing of it is Markdown or HTML.
std::string plain(const std::string& text) {
  constexpr std::string_view special = "\\`*_{}[]<>()#+-!|~&";
  std::string out;
  for (const char c : shortened(valid_utf8(text))) {
    if (static_cast<unsigned char>(c) < 0x20) {
      out += ' ';
      continue;
    }
    // Those between letters and digits mark nothing.
    if (special.find(c) != std::string_view::npos && c != '-' && c != '+' && c != '(' && c != ')')
      out += '\\';
    out += c;
  }
  return out;
}

// A block of code, whose fence is longer than any in it.
std::string code_block(const std::string& text) {
  std::size_t run = 0;
  std::size_t longest = 0;
  for (const char c : text) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  const std::string fence(std::max<std::size_t>(3, longest + 1), '`');
  return fmt::format("{}text\n{}\n{}\n", fence, valid_utf8(text), fence);
}

std::string finding_text(std::size_t number, const PlacedFinding& placed) {
  const GateFinding& f = *placed.finding;
  std::string text = fmt::format("{}. **{} {}** ({}): {} {}\n\n", number, plain(f.row), plain(f.type),
                                 plain(placed.result->records_directory), label_of(f.kind), plain(f.message));
  std::string details;
  for (const auto& [name, value] : details_of(f))
    details += fmt::format("{}{}: {}", details.empty() ? "" : "\n", name, shortened(value));
  if (!details.empty()) text += code_block(details) + "\n";
  return text;
}

std::string counts_text(const std::vector<GateResult>& results) {
  std::string text = "| records | rows |";
  std::string line = "|---|---|";
  for (std::size_t k = 0; k < finding_kind_count; ++k) {
    text += fmt::format(
        " {} |", k + 1 == finding_kind_count ? "can be lowered" : label_of(static_cast<FindingKind>(k)));
    line += "---|";
  }
  text += " verdict |\n" + line + "---|\n";
  for (const auto& r : results) {
    text += fmt::format("| {} | {} |", plain(r.records_directory), r.records);
    for (std::size_t k = 0; k < finding_kind_count; ++k)
      text += fmt::format(" {} |",
                          std::ranges::count(r.findings, static_cast<FindingKind>(k), &GateFinding::kind));
    text += fmt::format(" exit {} |\n", exit_code(r.verdict.standing()));
  }
  return text;
}

}  // namespace

std::string markdown_report(const std::vector<GateResult>& results) {
  const auto findings = worst_first(results);
  std::string text = fmt::format("## ulpgate gate: {}\n\n", verdict_words(results));
  for (const auto& r : results)
    for (const auto& remark : r.remarks)
      text += fmt::format("* {}: {}\n", plain(r.records_directory), plain(remark));
  text += "\n";
  for (std::size_t i = 0; i < std::min(most_findings, findings.size()); ++i)
    text += finding_text(i + 1, findings[i]);
  if (findings.size() > most_findings)
    text += fmt::format("... and {} more.\n\n", findings.size() - most_findings);
  text += counts_text(results) + "\n";
  for (const auto& r : results)
    if (!r.platform.empty()) text += fmt::format("* {}: {}\n", plain(r.budgets_directory), plain(r.platform));
  const std::size_t notes = count_of(results, FindingKind::could_lower);
  if (notes > 0)
    text += fmt::format("\n{} budgets are above twice what was measured: `--tighten` lowers them.\n", notes);
  if (text.size() <= most_bytes) return text;
  const std::size_t end = text.rfind('\n', most_bytes);
  return text.substr(0, end + 1) + "\n... cut: a summary may have 1 MiB.\n";
}

}  // namespace ulpgate::app
