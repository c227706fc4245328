// What a run records on its way.
#include "harness/app/scenes/scene_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "harness/app/scenes/scene_output.hpp"
#include "harness/app/shell/failure.hpp"
#include "harness/app/shell/files.hpp"
#include "harness/app/store/records.hpp"
#include "harness/core/arguments/random_words.hpp"
#include "harness/core/scenes/chain_angles.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::app {

namespace {

using Quantity = dem::BodyQuantity;
constexpr const char* checkpoint_directory = "checkpoints";
constexpr int checkpoint_version = 2;

std::filesystem::path ledger_file(const std::filesystem::path& out, const std::string& stem) {
  return out / checkpoint_directory / (stem + ".collisions");
}

std::uint64_t checksum(const Json& j) {
  return fnv1a(j.dump());
}

Json json_of(const Vouched& v) {
  return {{"bytes", v.bytes}, {"fnv1a", v.checksum}};
}
Vouched vouched_of(const Json& j) {
  return {j.at("bytes").get<std::uint64_t>(), j.at("fnv1a").get<std::uint64_t>()};
}

// The account's sum and the same with the half-step velocities, with what bits the subtraction needs.
struct Sums {
  MpfrValue averaged, raw;
};

Sums sums_of(const dem::DemEngine& engine, int bits) {
  const mpfr_prec_t wide = 2 * bits + 64;
  Sums s{MpfrValue(wide), MpfrValue(wide)};
  MpfrValue part;
  engine.energy_exact("sum", part);
  mpfr_set(s.averaged, part, MPFR_RNDN);
  mpfr_set(s.raw, part, MPFR_RNDN);
  for (const char* name : {"translational_on_step", "rotational_on_step"}) {
    engine.energy_exact(name, part);
    mpfr_sub(s.raw, s.raw, part, MPFR_RNDN);
  }
  engine.kinetic_energy_exact(part);
  mpfr_add(s.raw, s.raw, part, MPFR_RNDN);
  return s;
}

double difference(mpfr_srcptr a, mpfr_srcptr b) {
  MpfrValue d(mpfr_get_prec(a));
  mpfr_sub(d, a, b, MPFR_RNDN);
  return mpfr_get_d(d, MPFR_RNDN);
}

}  // namespace

SceneRecorder::SceneRecorder(std::filesystem::path out, RecordPlan plan, const dem::DemEngine& fresh)
    : out_(std::move(out)), plan_(std::move(plan)), energy_names_(fresh.energy_names()) {
  header_ = header(fresh);
  trajectory_header_ = trajectory_header(fresh);
}

std::string SceneRecorder::header(const dem::DemEngine& engine) const {
  std::string text = "step,time_s,kinetic_" + name_of(plan_.velocities) + "_J";
  for (const auto& name : energy_names_) text += "," + name;
  if (!energy_names_.empty()) text += ",energy_error_J,raw_energy_error_J";
  if (plan_.chain) {
    for (std::size_t i = 1; i + 1 < engine.bodies(); ++i) text += fmt::format(",angle_{}_rad", i);
    text += ",angle_product";
  }
  return text + ",mean_x_m,mean_y_m,mean_z_m\n";
}

std::string SceneRecorder::trajectory_header(const dem::DemEngine& engine) const {
  std::string text = "step,time_s";
  for (std::size_t i = 1; i + 1 < engine.bodies(); ++i) text += fmt::format(",angle_{}_rad", i);
  text += ",angle_product";
  for (std::size_t b = 0; b < engine.bodies(); ++b) {
    if (!engine.is_fixed(b)) text += fmt::format(",x_{0},y_{0},z_{0},vx_{0},vy_{0},vz_{0}", b);
  }
  for (const auto& name : energy_names_) text += "," + name;
  return text + "\n";
}

std::string SceneRecorder::trajectory_row(const dem::DemEngine& engine) const {
  std::string text = fmt::format("{},{}", engine.iteration(), engine.time_s());
  const auto put = [&](mpfr_srcptr x) { text += "," + to_decimal(x, plan_.digits); };
  const ExactChainAngles angles = exact_chain_angles(engine, plan_.bits);
  for (const auto& angle : angles.angles) put(angle);
  put(angles.product);
  MpfrValue x;
  for (std::size_t b = 0; b < engine.bodies(); ++b) {
    if (engine.is_fixed(b)) continue;
    for (const auto q : {Quantity::position, Quantity::velocity}) {
      for (std::size_t c = 0; c < 3; ++c) {
        engine.exact(q, b, c, x);
        put(x);
      }
    }
  }
  for (const auto& name : energy_names_) {
    engine.energy_exact(name, x);
    put(x);
  }
  return text + "\n";
}

void SceneRecorder::begin() {
  const auto start = [&](VouchedFile& file, const char* directory, const std::string& first_line) {
    make_directory(out_ / directory);
    file.begin(out_ / directory / (plan_.stem + ".csv"));
    file.append(first_line);
  };
  if (out_.empty()) return;
  if (plan_.series) start(series_, "series", header_);
  if (plan_.trajectory) start(trajectory_, "trajectory", trajectory_header_);
  if (plan_.collisions_of.is_null()) return;
  make_directory(out_ / checkpoint_directory);
  ledger_.begin(ledger_file(out_, plan_.stem));
}

void SceneRecorder::note_start(const dem::DemEngine& engine) {
  Sums sums = sums_of(engine, plan_.bits);
  statistics_.energy_start = mpfr_get_d(sums.averaged, MPFR_RNDN);
  start_sum_ = std::move(sums.averaged);
  start_raw_ = std::move(sums.raw);
}

void SceneRecorder::add(const dem::DemEngine& engine) {
  const std::uint64_t step = engine.iteration();
  std::string row = fmt::format("{},{},{}", step, engine.time_s(), engine.kinetic_energy());
  for (const auto& name : energy_names_) row += fmt::format(",{}", engine.energy(name));
  if (!energy_names_.empty()) {
    // The account belongs to the step before: there is none before the first step.
    double error = 0;
    double raw = 0;
    if (step != 0) {
      if (!start_sum_) note_start(engine);
      const Sums now = sums_of(engine, plan_.bits);
      error = difference(now.averaged, *start_sum_);
      raw = difference(now.raw, *start_raw_);
      statistics_.averaged.add(engine.time_s(), error);
      statistics_.raw.add(engine.time_s(), raw);
    }
    row += fmt::format(",{},{}", error, raw);
  }
  if (plan_.chain) {
    const auto angles = chain_angles(engine);
    const double product = product_of(angles);
    for (const double angle : angles) row += fmt::format(",{}", angle);
    row += fmt::format(",{}", product);
    if (plan_.record_every != 0 && step % plan_.record_every == 0) statistics_.products.push_back(product);
  }
  const auto mean = mean_position(engine);
  series_.append(row + fmt::format(",{},{},{}\n", mean[0], mean[1], mean[2]));
  if (trajectory_.is_open()) trajectory_.append(trajectory_row(engine));
}

void SceneRecorder::add_collision(const dem::CollisionRecord& record) {
  collisions_.add(record);
  if (collision_rows_ == most_collision_rows) return;
  ++collision_rows_;
  if (!ledger_.is_open()) return;
  Json row = {{"what", "collision"}};
  row.update(plan_.collisions_of);
  row.update(collision_json(record));
  row["plan"] = plan_.plan;
  ledger_.append(row.dump() + "\n");
}

void SceneRecorder::add_collisions(dem::DemEngine& engine) {
  for (const auto& record : engine.take_collisions()) add_collision(record);
}

void SceneRecorder::end_collisions(const dem::DemEngine& engine) {
  if (plan_.collisions_of.is_null()) return;
  for (const auto& record : engine.open_collisions()) add_collision(record);
  if (!ledger_.is_open()) return;
  Json row = {{"what", "ledger"}};
  row.update(plan_.collisions_of);
  row.update(ledger_json(collisions_, collision_rows_));
  row["plan"] = plan_.plan;
  ledger_.append(row.dump() + "\n");
}

std::string collision_lines_of(const std::filesystem::path& out, const std::string& stem) {
  return read_file(ledger_file(out, stem));
}

void SceneRecorder::replay(const std::string& series) {
  const auto fields_of = [](std::string_view line) {
    std::vector<std::string_view> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find(',', begin), line.size());
      fields.push_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
    return fields;
  };
  const auto names = fields_of(std::string_view(header_).substr(0, header_.size() - 1));
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  const std::size_t averaged = column("energy_error_J");
  const std::size_t raw = column("raw_energy_error_J");
  const std::size_t product = column("angle_product");
  std::size_t number = 1;
  for (std::size_t at = header_.size(); at < series.size(); ++number) {
    const std::size_t end = std::min(series.find('\n', at), series.size());
    const auto fields = fields_of(std::string_view(series).substr(at, end - at));
    at = end + 1;
    if (fields.size() != names.size()) {
      throw Failure(Standing::bad_input, fmt::format("series/{}.csv:{}: {} fields, the header has {}",
                                                     plan_.stem, number + 1, fields.size(), names.size()));
    }
    // Written as the shortest text that gives the same double back.
    const auto value = [&](std::size_t i) { return std::strtod(std::string(fields[i]).c_str(), nullptr); };
    const auto step = static_cast<std::uint64_t>(value(0));
    if (averaged < names.size() && step != 0) {
      statistics_.averaged.add(value(1), value(averaged));
      statistics_.raw.add(value(1), value(raw));
    }
    if (product < names.size() && plan_.record_every != 0 && step % plan_.record_every == 0)
      statistics_.products.push_back(value(product));
  }
}

std::filesystem::path SceneRecorder::checkpoint_file() const {
  return out_ / checkpoint_directory / (plan_.stem + ".json");
}

bool SceneRecorder::checkpoint_is_due() const {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - last_checkpoint_;
  return !out_.empty() && since.count() >= plan_.checkpoint_s;
}

void SceneRecorder::checkpoint(dem::DemEngine& engine) {
  if (out_.empty()) return;
  Json j = {{"ulpgate_checkpoint", checkpoint_version},
            {"plan", plan_.plan},
            {"stem", plan_.stem},
            {"step", engine.iteration()},
            {"series", json_of(series_.sync())},
            {"trajectory", json_of(trajectory_.sync())},
            {"state", engine.save()}};
  if (ledger_.is_open()) {
    j["collisions"] = {
        {"file", json_of(ledger_.sync())}, {"rows", collision_rows_}, {"totals", state_json(collisions_)}};
  }
  j["checksum"] = checksum(j);
  make_directory(out_ / checkpoint_directory);
  write_file(checkpoint_file(), j.dump() + "\n");
  last_checkpoint_ = std::chrono::steady_clock::now();
}

void SceneRecorder::close() {
  series_.sync();
  trajectory_.sync();
  ledger_.sync();
}

bool SceneRecorder::resume(dem::DemEngine& engine) {
  if (out_.empty() || !std::filesystem::exists(checkpoint_file())) return false;
  const std::string name = checkpoint_file().string();
  const auto refuse = [&](const std::string& why) -> Failure {
    return {Standing::bad_input, fmt::format("{}: {}; start again with --overwrite", name, why)};
  };
  Json j = Json::parse(read_file(name), nullptr, false);
  if (!j.is_object() || !j.contains("checksum")) throw refuse("no checkpoint, or a torn one");
  const std::uint64_t claimed = j["checksum"].is_number_unsigned() ? j["checksum"].get<std::uint64_t>() : 0;
  j.erase("checksum");
  if (checksum(j) != claimed) throw refuse("its checksum does not fit: it was changed");
  if (j["ulpgate_checkpoint"] != checkpoint_version) throw refuse("made by another version of ulpgate");
  if (j["plan"] != plan_.plan) throw refuse("made by another plan (scene, step, steps or records differ)");
  if (j.contains("collisions") == plan_.collisions_of.is_null())
    throw refuse(j.contains("collisions") ? "made with --collisions" : "made without --collisions");
  const auto go_on = [&](VouchedFile& file, const char* directory) {
    make_directory(out_ / directory);
    file.go_on(out_ / directory / (plan_.stem + ".csv"), vouched_of(j[directory]));
  };
  if (plan_.series) go_on(series_, "series");
  if (plan_.trajectory) go_on(trajectory_, "trajectory");
  if (j.contains("collisions")) {
    const Json& kept = j["collisions"];
    ledger_.go_on(ledger_file(out_, plan_.stem), vouched_of(kept.at("file")));
    collision_rows_ = kept.at("rows").get<std::uint64_t>();
    collisions_ = summary_of(kept.at("totals"));
  }
  // The first step gives the account that later ones are held against.
  if (!energy_names_.empty()) {
    engine.step(1);
    note_start(engine);
  }
  if (plan_.series) {
    const std::string series = read_file(out_ / "series" / (plan_.stem + ".csv"));
    if (!series.starts_with(header_)) throw refuse("the series has other columns");
    replay(series);
  }
  try {
    engine.restore(j["state"].get<std::string>(), dem::Constants::from_text);
  } catch (const std::invalid_argument& e) {
    throw refuse(fmt::format("its state is not one of this scene and type: {}", e.what()));
  }
  return true;
}

void remove_checkpoints(const std::filesystem::path& out) {
  if (out.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(out / checkpoint_directory, ignored);
}

}  // namespace ulpgate::app
