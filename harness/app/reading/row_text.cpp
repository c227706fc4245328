// Row text.
#include "harness/app/reading/row_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "harness/app/shell/failure.hpp"

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

std::uint64_t count_from(const Json& j) {
  if (!field::is_count(j)) throw std::invalid_argument(fmt::format("a count is {}", field::count.words));
  return j.get<std::uint64_t>();
}

std::uint64_t index_from(const Json& j) {
  return j.is_null() ? no_index : count_from(j);
}
// Others are refused with the histogram's own limits.
int bucket_from(const Json& j) {
  const bool fits = j.is_number_integer() && j.get<std::int64_t>() >= std::numeric_limits<int>::min() &&
                    j.get<std::int64_t>() <= std::numeric_limits<int>::max();
  if (!fits) throw std::invalid_argument("a bucket is a whole number");
  return j.get<int>();
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
    // Of foreign functions alone, where there are any.
    if (s.outcomes[o] > 0 || o <= static_cast<std::size_t>(Outcome::exception))
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

namespace {

// A record determines its line: a key that is unknown or absent, or a figure that does not follow from the
// counts, is what differs from it.
void hold_to_text(const RowRecord& r, const Json& found, const std::string& line) {
  const std::string text = to_json_line(r);
  if (text == line) return;
  const Json wanted = Json::parse(text);
  for (const auto& [key, value] : found.items()) {
    const auto it = wanted.find(key);
    if (it == wanted.end()) throw std::invalid_argument(fmt::format("unknown key '{}'", key));
    if (*it != value)
      throw std::invalid_argument(fmt::format("'{}' does not follow from the other figures", key));
  }
  for (const auto& [key, value] : wanted.items())
    if (!found.contains(key)) throw std::invalid_argument(fmt::format("'{}' is missing", key));
  throw std::invalid_argument("not written by this program");
}

}  // namespace

RowRecord from_json_line(const std::string& line, const std::string& place) {
  try {
    const Json j = parse_object(line, place);
    RowRecord r;
    Summary& s = r.summary;
    r.subject = j.at("function");
    r.part = j.at("part");
    r.type = j.at("type");
    r.subject_class = j.at("class");
    r.implementation = j.at("implementation");
    r.stratum = j.at("stratum");
    s.samples = count_from(j.at("samples"));
    r.planned = count_from(j.at("planned"));
    r.seed = count_from(j.at("seed"));
    s.max_error = {number_from(j.at("max_ulp")), index_from(j.at("argmax_index"))};
    r.points.argmax = j.at("argmax").get<std::vector<std::string>>();
    r.points.got = j.at("got");
    r.points.exact = j.at("exact");
    s.max_distance = number_from(j.at("max_float_distance"));
    s.sum = UlpSum::from_text(j.at("ulp_sum").get<std::string>());
    s.correctly_rounded = count_from(j.at("correctly_rounded"));
    s.outcomes[0] = count_from(j.at("judged"));
    if (s.outcomes[0] > 0) s.first_index[0] = 0;
    s.histogram.exact = count_from(j.at("histogram").at("exact"));
    for (const auto& bucket : j.at("histogram").at("buckets")) {
      s.histogram.counts[bucket_from(bucket.at(0))] = count_from(bucket.at(1));
    }
    for (std::size_t o = 1; o < outcome_count; ++o) {
      const std::string name(outcome_names[o]);
      if (o > static_cast<std::size_t>(Outcome::exception) && !j.at("mismatch").contains(name)) continue;
      s.outcomes[o] = count_from(j.at("mismatch").at(name));
      if (s.outcomes[o] > 0) {
        s.first_index[o] = count_from(j.at("mismatch_index").at(name));
        r.points.first_mismatch[static_cast<Outcome>(o)] =
            j.at("mismatch_first").at(name).get<std::vector<std::string>>();
      }
    }
    if (r.subject_class == kernel_class) {
      s.normwise = {number_from(j.at("max_normwise")), index_from(j.at("normwise_index"))};
      r.points.normwise_argmax = j.at("normwise_argmax").get<std::vector<std::string>>();
      r.points.condition = number_from(j.at("condition"));
      s.max_error_over_condition = number_from(j.at("max_normwise_over_condition"));
    } else {
      s.max_error_over_condition = number_from(j.at("max_ulp_over_condition"));
      s.oracle.compared = count_from(j.at("oracle").at("compared"));
      s.oracle.disagreed = count_from(j.at("oracle").at("disagreed"));
      s.oracle.difference = {number_from(j.at("oracle").at("max_difference_ulp")),
                             index_from(j.at("oracle").at("argmax_index"))};
      r.points.oracle_argmax = j.at("oracle").at("argmax").get<std::vector<std::string>>();
    }
    r.reference = j.at("reference");
    r.reference_bits = j.at("reference_bits");
    r.plan = j.at("plan");
    if (const auto why = contradiction(r)) throw std::invalid_argument(*why);
    hold_to_text(r, j, line);
    return r;
  } catch (const Failure&) {
    throw;
  } catch (const std::exception& e) {
    throw Failure(Standing::bad_input, fmt::format("{}: not a record: {}", place, e.what()));
  }
}

}  // namespace ulpgate::app
