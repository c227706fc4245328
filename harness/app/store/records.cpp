// Records.
#include "harness/app/store/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"

namespace ulpgate::app {

namespace {

double number_from(const Json& j) {
  if (j.is_null()) return -1;
  if (j.is_string()) {
    if (j.get<std::string>() != "inf") throw std::invalid_argument("a number or \"inf\" is wanted");
    return HUGE_VAL;
  }
  return j.get<double>();
}

std::uint64_t index_from(const Json& j) {
  return j.is_null() ? no_index : j.get<std::uint64_t>();
}
Json index_to(std::uint64_t k) {
  return k == no_index ? Json(nullptr) : Json(k);
}

}  // namespace

Json number_or_text(double x) {
  if (std::isnan(x) || x < 0) return nullptr;
  if (std::isinf(x)) return "inf";
  return x;
}

std::string to_json_line(const RowRecord& r) {
  const Summary& s = r.summary;
  Json buckets = Json::array();
  for (const auto& [i, n] : s.histogram.counts) buckets.push_back({i, n});
  Json mismatch = Json::object();
  Json first = Json::object();
  Json first_index = Json::object();
  for (std::size_t o = 1; o < outcome_count; ++o) {
    const std::string name(outcome_names[o]);
    mismatch[name] = s.outcomes[o];
    if (s.outcomes[o] > 0) {
      first[name] = r.points.first_mismatch.at(static_cast<Outcome>(o));
      first_index[name] = s.first_index[o];
    }
  }
  Json j;
  j["function"] = r.subject;
  j["part"] = r.part;
  j["type"] = r.type;
  j["class"] = r.subject_class;
  j["implementation"] = r.implementation;
  j["stratum"] = r.stratum;
  j["samples"] = s.samples;
  j["planned"] = r.planned;
  j["seed"] = r.seed;
  j["max_ulp"] = number_or_text(s.max_error.value);
  j["argmax"] = r.points.argmax;
  j["argmax_index"] = index_to(s.max_error.index);
  j["got"] = r.points.got;
  j["exact"] = r.points.exact;
  j["max_float_distance"] = number_or_text(s.max_distance);
  j["mean_ulp"] = number_or_text(s.sum.mean(s.judged()));
  j["p50_ulp"] = number_or_text(s.histogram.quantile(0.5));
  j["p99_ulp"] = number_or_text(s.histogram.quantile(0.99));
  j["ulp_sum"] = s.sum.to_text();
  j["correctly_rounded"] = s.correctly_rounded;
  j["judged"] = s.judged();
  j["histogram"] = {{"exact", s.histogram.exact}, {"buckets", buckets}};
  j["mismatch"] = mismatch;
  j["mismatch_first"] = first;
  j["mismatch_index"] = first_index;
  if (r.subject_class == kernel_class) {
    j["max_normwise"] = number_or_text(s.normwise.value);
    j["normwise_argmax"] = r.points.normwise_argmax;
    j["normwise_index"] = index_to(s.normwise.index);
    j["condition"] = number_or_text(r.points.condition);
    j["max_normwise_over_condition"] = number_or_text(s.max_error_over_condition);
    j["verdict"] = is_stable(s) ? "stable" : "unstable";
  } else {
    j["max_ulp_over_condition"] = number_or_text(s.max_error_over_condition);
    j["oracle"] = {{"compared", s.oracle.compared},
                   {"disagreed", s.oracle.disagreed},
                   {"max_difference_ulp", number_or_text(s.oracle.difference.value)},
                   {"argmax", r.points.oracle_argmax},
                   {"argmax_index", index_to(s.oracle.difference.index)}};
  }
  if (is_proof(r)) j["proof"] = true;
  j["reference"] = r.reference;
  j["reference_bits"] = r.reference_bits;
  j["plan"] = r.plan;
  return j.dump();
}

RowRecord from_json_line(const std::string& line, const std::string& place) {
  try {
    const Json j = Json::parse(line);
    RowRecord r;
    Summary& s = r.summary;
    r.subject = j.at("function");
    r.part = j.at("part");
    r.type = j.at("type");
    r.subject_class = j.at("class");
    r.implementation = j.at("implementation");
    r.stratum = j.at("stratum");
    s.samples = j.at("samples");
    r.planned = j.at("planned");
    r.seed = j.at("seed");
    s.max_error = {number_from(j.at("max_ulp")), index_from(j.at("argmax_index"))};
    r.points.argmax = j.at("argmax").get<std::vector<std::string>>();
    r.points.got = j.at("got");
    r.points.exact = j.at("exact");
    s.max_distance = number_from(j.at("max_float_distance"));
    s.sum = UlpSum::from_text(j.at("ulp_sum").get<std::string>());
    s.correctly_rounded = j.at("correctly_rounded");
    s.outcomes[0] = j.at("judged");
    if (s.outcomes[0] > 0) s.first_index[0] = 0;
    s.histogram.exact = j.at("histogram").at("exact");
    for (const auto& bucket : j.at("histogram").at("buckets")) {
      s.histogram.counts[bucket.at(0).get<int>()] = bucket.at(1).get<std::uint64_t>();
    }
    std::uint64_t total = s.outcomes[0];
    for (std::size_t o = 1; o < outcome_count; ++o) {
      const std::string name(outcome_names[o]);
      s.outcomes[o] = j.at("mismatch").at(name);
      total += s.outcomes[o];
      if (s.outcomes[o] > 0) {
        s.first_index[o] = j.at("mismatch_index").at(name);
        r.points.first_mismatch[static_cast<Outcome>(o)] =
            j.at("mismatch_first").at(name).get<std::vector<std::string>>();
      }
    }
    if (total != s.samples)
      throw std::invalid_argument("judged and mismatched samples do not add up to samples");
    if (r.subject_class == kernel_class) {
      s.normwise = {number_from(j.at("max_normwise")), index_from(j.at("normwise_index"))};
      r.points.normwise_argmax = j.at("normwise_argmax").get<std::vector<std::string>>();
      r.points.condition = number_from(j.at("condition"));
      s.max_error_over_condition = number_from(j.at("max_normwise_over_condition"));
    } else {
      s.max_error_over_condition = number_from(j.at("max_ulp_over_condition"));
      s.oracle.compared = j.at("oracle").at("compared");
      s.oracle.disagreed = j.at("oracle").at("disagreed");
      s.oracle.difference = {number_from(j.at("oracle").at("max_difference_ulp")),
                             index_from(j.at("oracle").at("argmax_index"))};
      r.points.oracle_argmax = j.at("oracle").at("argmax").get<std::vector<std::string>>();
    }
    r.reference = j.at("reference");
    r.reference_bits = j.at("reference_bits");
    r.plan = j.at("plan");
    return r;
  } catch (const std::exception& e) {
    throw Failure(ExitCode::bad_input, fmt::format("{}: not a record: {}", place, e.what()));
  }
}

RecordSet read_records(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) {
    throw Failure(ExitCode::bad_input, fmt::format("{}: no such directory", directory.string()));
  }
  RecordSet set;
  const auto context = directory / "context.json";
  set.file =
      std::filesystem::exists(directory / kernel_records_file) ? kernel_records_file : math_records_file;
  const auto records = directory / set.file;
  if (!std::filesystem::exists(context) && !std::filesystem::exists(records)) {
    throw Failure(ExitCode::incomplete,
                  fmt::format("{}: nothing measured there: no {} or {}", directory.string(),
                              math_records_file, kernel_records_file));
  }
  try {
    set.context = Json::parse(read_file(context));
  } catch (const Json::exception& e) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("{}: not a run's context: {}", context.string(), e.what()));
  }
  std::size_t number = 0;
  for (const auto& line : read_lines(records)) {
    set.records.push_back(from_json_line(line, fmt::format("{}:{}", records.string(), ++number)));
    if (set.records.back().plan != set.context.value("plan", "")) {
      throw Failure(ExitCode::bad_input, fmt::format("{}:{}: plan {} is not that of context.json",
                                                     records.string(), number, set.records.back().plan));
    }
  }
  return set;
}

void write_context(const std::filesystem::path& out, Json context, bool finished) {
  context["finished"] = finished;
  write_file(out / "context.json", context.dump(2) + "\n");
}

bool is_finished(const std::filesystem::path& out, const std::string& plan_hash, const std::string& shard) {
  if (!std::filesystem::exists(out / "context.json") || std::filesystem::exists(out / "units")) return false;
  const Json context = Json::parse(read_file(out / "context.json"), nullptr, false);
  return context.is_object() && context.value("plan", "") == plan_hash && context.value("finished", false) &&
         context.value("shards", Json()) == Json({shard});
}

void guard_output(const std::filesystem::path& out, const std::string& plan_hash, bool overwrite) {
  const auto context = out / "context.json";
  if (!std::filesystem::exists(context)) return;
  std::string there;
  try {
    there = Json::parse(read_file(context)).value("plan", "");
  } catch (const Json::exception&) {
    there = "unreadable";
  }
  if (there == plan_hash) return;
  if (!overwrite) {
    throw Failure(ExitCode::bad_input,
                  fmt::format("{} holds the records of another plan ({}); choose another --out or "
                              "give --overwrite",
                              out.string(), there));
  }
  // The other plan's records must not stand beside the new context.
  for (const auto* file : {math_records_file, kernel_records_file, "timing.jsonl"})
    std::filesystem::remove(out / file);
}

std::string records_text(std::vector<RowRecord> records) {
  std::ranges::sort(records, {}, [](const RowRecord& r) { return r.key(); });
  std::string text;
  for (const auto& r : records) text += to_json_line(r) + "\n";
  return text;
}

}  // namespace ulpgate::app
