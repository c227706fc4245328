// SceneReference.
#include "harness/app/advice/scene_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/app/shell/selection.hpp"
#include "harness/core/scenes/chain_angles.hpp"
#include "harness/core/scenes/correlation.hpp"
#include "harness/core/subject/registry.hpp"
#include "harness/core/work_precision/trajectory_setting.hpp"
#include "kernels/ode/integrators/integrators.hpp"
#include "reference/text/text.hpp"

namespace ulpgate::app {

namespace {

constexpr std::uint64_t most_instants = 64;
// Numbers kept of a run, over all instants.
constexpr std::uint64_t most_positions = 200'000;

// The largest divisor of n up to `most`.
std::uint64_t largest_divisor(std::uint64_t n, std::uint64_t most) {
  for (std::uint64_t d = std::min(n, most); d > 1; --d)
    if (n % d == 0) return d;
  return 1;
}

std::string shortest_type(long bits) {
  const RealDescriptor* best = nullptr;
  for (const auto& type : all_types()) {
    if (type.reference_bits < bits) continue;
    if (best == nullptr || type.reference_bits < best->reference_bits) best = &type;
  }
  if (best != nullptr) return best->token;
  // Of all that were built the most precise.
  best = &*std::ranges::max_element(all_types(), {}, &RealDescriptor::reference_bits);
  return best->token;
}

std::string highest_admitted(const SceneRequest& scene, const std::string& token) {
  std::string best = "leapfrog";
  int order = 0;
  for (const auto& i : ode::integrators()) {
    if (i.kind != ode::IntegratorKind::splitting || i.order.value_or(0) <= order) continue;
    if (i.name != "leapfrog" && !admits(scene, token, i.name)) continue;
    best = i.name;
    order = i.order.value_or(0);
  }
  return best;
}

class ReferenceRuns {
 public:
  explicit ReferenceRuns(const ReferenceRequest& request)
      : request_(request),
        // Enough that its own rounding, grown as that of the runs, stays out of sight.
        token_(shortest_type(request.bits + 48)),
        integrator_(highest_admitted(request.scene, token_)) {}

  [[nodiscard]] SceneReference run(const ode::StopFlag& stop) {
    SceneReference reference;
    const std::uint64_t coarsest = coarsest_steps();
    int halvings = 0;
    if (integrator_ == "leapfrog") {
      while ((coarsest << static_cast<unsigned>(halvings)) < 4 * request_.finest_steps) ++halvings;
    }
    SceneView before = view(halvings, reference, stop);
    while (true) {
      reference.view = view(++halvings, reference, stop);
      const auto errors = position_errors(before, reference.view, reference.size_m);
      reference.error = *std::ranges::max_element(errors);
      if (reference.error <= request_.wanted_error || 2 * work_ > request_.most_work) break;
      const std::uint64_t next = coarsest << static_cast<unsigned>(halvings + 1);
      if (integrator_ == "leapfrog" && request_.most_steps != 0 && next > request_.most_steps) break;
      before = std::move(reference.view);
    }
    reference.text = fmt::format("{}, dt = {}, RealHP<4> of {}", integrator_,
                                 scaled_dt(*request_.scene.dt, -halvings), token_);
    if (!std::isfinite(reference.error)) {
      throw std::runtime_error(
          fmt::format("the reference ({}) does not converge: its runs are no numbers", reference.text));
    }
    return reference;
  }

 private:
  [[nodiscard]] std::uint64_t coarsest_steps() const { return std::stoull(*request_.scene.steps); }

  SceneView view(int halvings, SceneReference& reference, const ode::StopFlag& stop) {
    SceneRequest scene = request_.scene;
    const std::uint64_t steps = coarsest_steps() << static_cast<unsigned>(halvings);
    scene.dt = scaled_dt(*request_.scene.dt, -halvings);
    scene.steps = std::to_string(steps);
    scene.integrator = integrator_;
    const SceneJob job = make_job(scene);
    const auto engine = engine_of(token_, dem::Level::reference, job);
    reference.size_m = scene_size(*engine);
    work_ =
        static_cast<double>(steps) * static_cast<double>(engine->bodies()) * evaluations_of_step(integrator_);
    SceneView view;
    const SceneInstants& at = request_.instants;
    if (at.angles) view.products.push_back(product_of(chain_angles(*engine)));
    const std::uint64_t stride = steps / at.records;
    for (std::uint64_t record = 1; record <= at.records; ++record) {
      const std::uint64_t last = record * stride;
      while (engine->iteration() < last) {
        stop.check();
        engine->step(std::min<std::uint64_t>(last - engine->iteration(), 256));
      }
      if (at.angles) view.products.push_back(product_of(chain_angles(*engine)));
      if (record % (at.records / at.positions) == 0) add_positions(*engine, view);
    }
    return view;
  }

  const ReferenceRequest& request_;
  std::string token_;
  std::string integrator_;
  double work_ = 0;  // of the last run
};

}  // namespace

std::string ReferenceRequest::key() const {
  return fmt::format(
      "scene reference of {}\ndt {} steps {} finest {} positions {} records {} angles {} bits {} "
      "wanted {:a} most steps {} work {:a}",
      load_scene(scene.name, scene.overrides).text, *scene.dt, *scene.steps, finest_steps, instants.positions,
      instants.records, instants.angles, bits, wanted_error, most_steps, most_work);
}

const std::string& rough_type() {
  const RealDescriptor* type = find_type("double");
  return type != nullptr ? type->token : all_types().front().token;
}

SceneInstants instants_of(const SceneJob& job, double dt_s, const std::vector<std::uint64_t>& steps,
                          double until_s) {
  std::uint64_t common = 0;
  for (const auto n : steps) common = std::gcd(common, n);
  SceneInstants at;
  const double record_s = dt_s * static_cast<double>(job.record_every);
  if (record_s > 0 && job.loaded.scene.records("angles")) {
    const auto most = static_cast<std::uint64_t>(until_s / record_s * (1 + 1e-9));
    at.records = largest_divisor(common, std::max<std::uint64_t>(1, most));
    at.angles = at.records >= CorrelationRule().chunk;
    if (!at.angles) at.records = 1;
  }
  const auto engine = engine_of(rough_type(), dem::Level::own, job);
  const std::uint64_t affordable = std::max<std::uint64_t>(1, most_positions / (3 * engine->bodies() + 1));
  at.positions =
      largest_divisor(at.angles ? at.records : common, std::min<std::uint64_t>(most_instants, affordable));
  if (!at.angles) at.records = at.positions;
  return at;
}

double scene_size(const dem::DemEngine& engine) {
  double size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = HUGE_VAL;
    double greatest = -HUGE_VAL;
    for (std::size_t b = 0; b < engine.bodies(); ++b) {
      const double x = engine.approximate(dem::BodyQuantity::position, b, axis);
      const double r = engine.radius(b);
      least = std::min(least, x - r);
      greatest = std::max(greatest, x + r);
    }
    size = std::max(size, greatest - least);
  }
  return size > 0 ? size : 1;
}

void add_positions(const dem::DemEngine& engine, SceneView& view) {
  std::vector<MpfrValue> state;
  for (std::size_t b = 0; b < engine.bodies(); ++b) {
    if (engine.is_fixed(b)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      engine.exact(dem::BodyQuantity::position, b, axis, state.emplace_back());
  }
  view.positions.push_back(std::move(state));
}

std::vector<double> position_errors(const SceneView& got, const SceneView& wanted, double size_m) {
  std::vector<double> errors;
  MpfrValue difference(64);
  for (std::size_t i = 0; i < wanted.positions.size(); ++i) {
    double largest = 0;
    for (std::size_t k = 0; k < wanted.positions[i].size(); ++k) {
      mpfr_sub(difference, got.positions[i][k], wanted.positions[i][k], MPFR_RNDN);
      const double off = std::fabs(mpfr_get_d(difference, MPFR_RNDN)) / size_m;
      // A NaN stays.
      if (!(off <= largest)) largest = off;
    }
    errors.push_back(largest);
  }
  return errors;
}

std::string scaled_dt(const std::string& dt, int k) {
  if (k == 0) return dt;
  const bool plain = dt.find_first_not_of("0123456789.eE+-") == std::string::npos;
  return fmt::format("{}{}{}", plain ? dt : "(" + dt + ")", k > 0 ? '*' : '/',
                     std::uint64_t{1} << static_cast<unsigned>(std::abs(k)));
}

bool admits(const SceneRequest& scene, const std::string& token, const std::string& integrator) {
  SceneRequest request = scene;
  request.integrator = integrator;
  try {
    static_cast<void>(engine_of(token, dem::Level::own, make_job(request)));
    return true;
  } catch (const Failure&) {
    return false;
  }
}

std::vector<std::string> SceneReference::to_lines() const {
  std::vector<std::string> lines = {fmt::format("r {} {} {}", to_hexfloat(size_m), to_hexfloat(error), text)};
  for (const auto& instant : view.positions) {
    std::string line = "p";
    for (const auto& x : instant) line += fmt::format(" {}:{}", mpfr_get_prec(x.get()), to_hexfloat(x.get()));
    lines.push_back(std::move(line));
  }
  std::string products = "a";
  for (const double x : view.products) products += " " + to_hexfloat(x);
  lines.push_back(std::move(products));
  return lines;
}

std::optional<SceneReference> SceneReference::from_lines(const std::vector<std::string>& lines) {
  SceneReference r;
  try {
    for (const auto& line : lines) {
      auto words = split(line, ' ');
      if (words.front() == "r" && words.size() > 3) {
        r.size_m = parse_real<double>(words[1]);
        r.error = parse_real<double>(words[2]);
        r.text = line.substr(words[0].size() + words[1].size() + words[2].size() + 3);
      } else if (words.front() == "p") {
        auto& instant = r.view.positions.emplace_back();
        for (std::size_t i = 1; i < words.size(); ++i) {
          const std::size_t colon = words[i].find(':');
          auto& x = instant.emplace_back(std::stol(words[i].substr(0, colon)));
          const std::string number = words[i].substr(colon + 1);
          char* end = nullptr;
          if (mpfr_strtofr(x, number.c_str(), &end, 0, MPFR_RNDN) != 0 || *end != '\0') return std::nullopt;
        }
      } else if (words.front() == "a") {
        for (std::size_t i = 1; i < words.size(); ++i)
          r.view.products.push_back(parse_real<double>(words[i]));
      }
    }
  } catch (const std::logic_error&) {
    return std::nullopt;
  }
  return r.text.empty() || r.view.positions.empty() ? std::nullopt : std::optional(std::move(r));
}

SharedReference shared_reference(ReferenceRequest request, KeptPlace kept) {
  return std::make_shared<Shared<SceneReference>>(
      [request = std::move(request), kept = std::move(kept)](const ode::StopFlag& stop) {
        if (!kept || !*kept) return ReferenceRuns(request).run(stop);
        const std::string key = request.key();
        if (const auto lines = (*kept)->find(key)) {
          if (auto found = SceneReference::from_lines(*lines)) return std::move(*found);
        }
        SceneReference made = ReferenceRuns(request).run(stop);
        (*kept)->keep(key, made.to_lines());
        return made;
      });
}

}  // namespace ulpgate::app
