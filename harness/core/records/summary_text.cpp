// Summary as text: one table of fields serves both directions.
#include "harness/core/records/summary_text.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>

namespace ulpgate {

namespace {

class Writer {
 public:
  void field(std::uint64_t n) { fmt::format_to(std::back_inserter(text), "{} ", n); }
  void field(int n) { fmt::format_to(std::back_inserter(text), "{} ", n); }
  // Its bits: every double, infinities included, comes back as it was.
  void field(double x) { fmt::format_to(std::back_inserter(text), "{:x} ", std::bit_cast<std::uint64_t>(x)); }
  void field(const UlpSum& sum) { text += sum.to_text() + " "; }
  void field(const std::map<int, std::uint64_t>& counts) {
    field(std::uint64_t{counts.size()});
    for (const auto& [i, n] : counts) {
      field(i);
      field(n);
    }
  }

  std::string text;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  void field(std::uint64_t& n) { parse(n, 10); }
  void field(int& n) { parse(n, 10); }
  void field(double& x) {
    std::uint64_t bits = 0;
    parse(bits, 16);
    x = std::bit_cast<double>(bits);
  }
  void field(UlpSum& sum) {
    const std::string_view word = next();
    good = good && !word.empty() && word.size() <= 32 &&
           word.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    if (good) sum = UlpSum::from_text(word);
  }
  void field(std::map<int, std::uint64_t>& counts) {
    std::uint64_t size = 0;
    field(size);
    for (std::uint64_t j = 0; j < size && good; ++j) {
      int i = 0;
      std::uint64_t n = 0;
      field(i);
      field(n);
      good = good && counts.emplace(i, n).second;
    }
  }
  [[nodiscard]] bool at_end() const { return rest_.empty(); }

  bool good = true;

 private:
  std::string_view next() {
    const std::size_t end = std::min(rest_.find(' '), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return word;
  }
  template <class Integer>
  void parse(Integer& n, int base) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), n, base);
    good = good && error == std::errc() && end == word.data() + word.size();
  }

  std::string_view rest_;
};

template <class Archive, class AnySummary>
void exchange(Archive& archive, AnySummary& s) {
  archive.field(s.samples);
  archive.field(s.correctly_rounded);
  for (auto& n : s.outcomes) archive.field(n);
  for (auto& k : s.first_index) archive.field(k);
  archive.field(s.max_error.value);
  archive.field(s.max_error.index);
  archive.field(s.max_distance);
  archive.field(s.max_error_over_condition);
  archive.field(s.normwise.value);
  archive.field(s.normwise.index);
  archive.field(s.histogram.exact);
  archive.field(s.histogram.counts);
  archive.field(s.sum);
  archive.field(s.oracle.compared);
  archive.field(s.oracle.disagreed);
  archive.field(s.oracle.difference.value);
  archive.field(s.oracle.difference.index);
}

}  // namespace

std::string summary_to_text(const Summary& s) {
  Writer writer;
  exchange(writer, s);
  writer.text.pop_back();
  return std::move(writer.text);
}

std::optional<Summary> summary_from_text(std::string_view text) {
  Reader reader(text);
  Summary s;
  exchange(reader, s);
  if (!reader.good || !reader.at_end()) return std::nullopt;
  return s;
}

}  // namespace ulpgate
