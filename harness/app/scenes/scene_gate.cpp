// The gate over records of scenes.
#include "harness/app/scenes/scene_gate.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/shell/selection.hpp"
#include "harness/app/store/records.hpp"

namespace ulpgate::app {

namespace {

constexpr const char* correlations_file = "correlation.jsonl";

std::vector<Json> read_rows(const std::filesystem::path& file) {
  std::vector<Json> rows;
  const auto lines = read_lines(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Json j = Json::parse(lines[i], nullptr, false);
    for (const char* key : {"scene", "type", "dt", "variant"}) {
      if (!j.is_object() || !j.contains(key) || !j[key].is_string())
        throw Failure(ExitCode::bad_input,
                      fmt::format("{}:{}: no record of a scene, or a torn one", file.string(), i + 1));
    }
    rows.push_back(std::move(j));
  }
  return rows;
}

std::optional<double> number_at(const Json& j, const char* key) {
  const auto it = j.find(key);
  if (it == j.end()) return std::nullopt;
  // A number that is not finite is written as null.
  return it->is_number() ? it->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '"' || c == '\\' ? std::string("\\") + c : c == '\n' ? " " : std::string(1, c);
  return '"' + out + '"';
}

// Expressions hold brackets and stars, which a shell would take.
std::string shell_word(const std::string& text) {
  const bool plain = text.find_first_of("()* ") == std::string::npos;
  return plain ? text : "'" + text + "'";
}

}  // namespace

bool has_scene_records(const std::filesystem::path& directory) {
  return std::filesystem::exists(directory / scene_records_file);
}

std::vector<SceneMeasurement> read_scene_measurements(const std::filesystem::path& directory) {
  std::vector<SceneMeasurement> measured;
  std::vector<Json> correlations;
  if (std::filesystem::exists(directory / correlations_file))
    correlations = read_rows(directory / correlations_file);
  for (const Json& j : read_rows(directory / scene_records_file)) {
    SceneMeasurement m;
    m.scene = j["scene"];
    m.type = j["type"];
    const std::string dt = j["dt"];
    const std::string variant = j["variant"];
    const auto steps = j.value("steps", std::uint64_t{0});
    m.run = fmt::format("dt={} steps={}{}{}", dt, steps, variant.empty() ? "" : " ", variant);
    // Without an account both errors are 0 and say nothing.
    if (j.contains("energy") && j["energy"].is_object()) {
      m.max_energy_error = number_at(j, "max_energy_error");
      m.max_energy_error_raw = number_at(j, "max_energy_error_raw");
    }
    const std::string run =
        fmt::format("{} --types {} --dt {} --steps {}", m.scene, m.type, shell_word(dt), steps);
    m.reproduce = fmt::format("ulpgate scene run {} --series --out DIR", run);
    for (const Json& c : correlations) {
      if (c["type"] != m.type || c["against"] == "RealHP4" || c["against"] == "half_step") continue;
      m.t_s = number_at(c, "t_s");
      m.reproduce = fmt::format("ulpgate scene correlate {} --reference {} --series --out DIR", run,
                                c["against"].get<std::string>());
    }
    const std::string integrator = j.value("integrator", "leapfrog");
    if (integrator != "leapfrog") m.reproduce += " --integrator " + integrator;
    for (const auto& change : split(variant, ',')) m.reproduce += " --set " + shell_word(change);
    measured.push_back(std::move(m));
  }
  return measured;
}

SceneBudgets read_scene_budgets(const std::filesystem::path& directory) {
  SceneBudgets budgets;
  if (!std::filesystem::is_directory(directory)) return budgets;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string file = entry.path().string();
    const auto bad = [&](const toml::node& node, const std::string& what) {
      return Failure(ExitCode::bad_input, fmt::format("{}:{}: {}", file, node.source().begin.line, what));
    };
    try {
      const toml::table table = toml::parse(read_file(entry.path()), file);
      auto& rows = budgets[entry.path().stem().string()];
      for (const auto& [section, node] : table) {
        if (section != "budget" || !node.is_table())
          throw bad(node, fmt::format("unknown section '{}'", section.str()));
        for (const auto& [name, value] : *node.as_table()) {
          if (!value.is_table()) throw bad(value, fmt::format("budget '{}' must be a table", name.str()));
          SceneBudget& b = rows[std::string(name.str())];
          for (const auto& [key, number] : *value.as_table()) {
            if (key == "reason" && number.is_string()) {
              b.reason = *number.value<std::string>();
              continue;
            }
            auto* const limit = key == "t_s"                    ? &b.t_s
                                : key == "max_energy_error"     ? &b.max_energy_error
                                : key == "max_energy_error_raw" ? &b.max_energy_error_raw
                                                                : nullptr;
            const auto x = number.value<double>();
            if (limit == nullptr || !x || !(*x >= 0))
              throw bad(number, fmt::format("['{}'] {} must be one of t_s, max_energy_error, "
                                            "max_energy_error_raw and a number >= 0, or a reason",
                                            name.str(), key.str()));
            *limit = *x;
          }
        }
      }
    } catch (const toml::parse_error& e) {
      throw Failure(ExitCode::bad_input,
                    fmt::format("{}:{}: {}", file, e.source().begin.line, e.description()));
    }
  }
  return budgets;
}

void write_scene_budgets(const std::filesystem::path& directory, const SceneBudgets& budgets) {
  make_directory(directory);
  for (const auto& [scene, rows] : budgets) {
    std::string text = fmt::format(
        "# Budgets of {}: the least t_s (s) and the largest energy errors (J) of every type and run.\n"
        "# Written by `ulpgate gate DIR --budgets DIR --update`; loosened only with `--reason`.\n",
        scene);
    for (const auto& [key, b] : rows) {
      text += fmt::format("\n[budget.{}]\n", quoted(key));
      const auto put = [&](const char* name, const std::optional<double>& x) {
        if (x) text += fmt::format("{} = {:#}\n", name, *x);
      };
      put("t_s", b.t_s);
      put("max_energy_error", b.max_energy_error);
      put("max_energy_error_raw", b.max_energy_error_raw);
      if (!b.reason.empty()) text += fmt::format("reason = {}\n", quoted(b.reason));
    }
    write_file(directory / (scene + ".toml"), text);
  }
}

}  // namespace ulpgate::app
