// Reading and validating a scene.
#include "kernels/scenes/reader/scene_reader.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <sstream>

#include "kernels/scenes/reader/toml_fields.hpp"

namespace ulpgate::scenes {

namespace {

const std::vector<std::string> recordable = {"energy",   "positions", "velocities", "orientation",
                                             "rotation", "contacts",  "angles"};

// Calls `read` on every table of the array of tables `key`, with path "key[i]".
void each_table(Document& document, Fields& root, std::string_view key,
                const std::function<void(Fields&)>& read) {
  const toml::node* node = root.find(key);
  if (node == nullptr) return;
  const toml::array* array = node->as_array();
  if (array == nullptr)
    return root.fail(node, key, "must be an array of tables: [[" + std::string(key) + "]]");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string path = std::string(key) + "[" + std::to_string(i) + "]";
    const toml::table* table = (*array)[i].as_table();
    if (table == nullptr) {
      document.error(&(*array)[i], path, "must be a table");
      continue;
    }
    Fields fields(document, *table, path);
    read(fields);
    fields.finish();
  }
}

// The name becomes part of the names of files.
void read_name(Fields& root, Scene& scene) {
  root.required_string("name", scene.name);
  const auto allowed = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_' || c == '+' || c == '-';
  };
  constexpr std::size_t longest = 100;
  if (scene.name.empty()) return;
  if (std::isalnum(static_cast<unsigned char>(scene.name.front())) == 0 || scene.name.size() > longest ||
      !std::all_of(scene.name.begin(), scene.name.end(), allowed)) {
    root.fail(root.find("name"), "name",
              "must be up to " + std::to_string(longest) +
                  " letters, digits, '.', '_', '+' and '-', a letter or digit first: it names files");
  }
}

void read_constants(Document& document, Fields& root, Scene& scene) {
  const toml::node* node = root.find("constants");
  if (node == nullptr) return;
  const toml::table* table = node->as_table();
  if (table == nullptr) return root.fail(node, "constants", "must be a table");
  // TOML tables are unordered for the parser: the order of the lines is the order of definition.
  std::vector<std::pair<toml::source_position, std::string>> order;
  for (const auto& [key, value] : *table) order.emplace_back(value.source().begin, key.str());
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.line, a.first.column) < std::pair(b.first.line, b.first.column);
  });
  Fields fields(document, *table, "constants");
  for (const auto& [position, key] : order) {
    Expression text;
    fields.number(key, text);
    if (text.empty()) continue;
    if (const std::string fault = constant_name_fault(key); !fault.empty()) {
      fields.fail(table->get(key), key, fault);
      continue;
    }
    scene.constants.emplace_back(key, text);
    document.constants.define(key, document.constants(text));
  }
}

void read_material(Fields& f, Scene& scene) {
  Material m;
  f.required_string("name", m.name);
  f.number("density", m.density, Range::positive);
  f.number("young", m.young, Range::positive);
  f.number("stiffness", m.stiffness, Range::positive);
  f.number("poisson", m.poisson, Range::below_one);
  f.number("friction_angle", m.friction_angle, Range::acute);
  f.number("collision_time", m.collision_time, Range::positive);
  f.number("restitution_normal", m.restitution_normal, Range::unit_open_closed);
  f.number("restitution_tangential", m.restitution_tangential, Range::unit_open_closed);
  f.number("cohesion", m.cohesion, Range::not_negative);
  f.number("adhesion", m.adhesion, Range::not_negative);
  f.number("moment_stiffness", m.moment_stiffness, Range::positive);
  for (const Material& other : scene.materials) {
    if (other.name == m.name) f.fail(nullptr, "name", "'" + m.name + "' is defined twice");
  }
  scene.materials.push_back(m);
}

void read_use_of_material(Fields& f, const Scene& scene, std::string& out) {
  f.string("material", out);
  if (out.empty() && scene.materials.size() == 1) out = scene.materials.front().name;
  if (out.empty()) return f.fail(f.find("material"), "material", "is missing");
  for (const Material& m : scene.materials) {
    if (m.name == out) return;
  }
  f.fail(f.find("material"), "material", "there is no material '" + out + "'");
}

void read_sphere(Fields& f, Scene& scene) {
  SphereSpec s;
  f.required_triple("position", s.position);
  f.triple("velocity", s.velocity);
  f.triple("angular_velocity", s.angular_velocity);
  f.required_number("radius", s.radius, Range::positive);
  f.boolean("fixed", s.fixed);
  f.number("mass", s.mass, Range::positive);
  if (f.find("inertia") != nullptr) {
    s.inertia = Triple{"1", "1", "1"};
    f.triple("inertia", *s.inertia, Range::positive);
  }
  read_use_of_material(f, scene, s.material);
  scene.spheres.push_back(s);
}

void read_counts(Fields& f, Generator& g) {
  const toml::node* node = f.require("counts");
  const toml::array* array = node == nullptr ? nullptr : node->as_array();
  for (std::size_t i = 0; i < 3; ++i) {
    const auto* n = array != nullptr && array->size() == 3 ? (*array)[i].as_integer() : nullptr;
    if (n == nullptr || n->get() < 1 || n->get() > 1000) {
      return f.fail(node, "counts", "must be three integers from 1 to 1000");
    }
    g.counts[i] = static_cast<int>(n->get());
  }
}

void read_generator(Fields& f, Scene& scene) {
  Generator g;
  f.require("kind");
  f.choice<GeneratorKind>("kind", g.kind,
                          {{"hexagonal_ball", GeneratorKind::hexagonal_ball},
                           {"grid", GeneratorKind::grid},
                           {"facet_box", GeneratorKind::facet_box}});
  read_use_of_material(f, scene, g.material);
  if (g.kind == GeneratorKind::facet_box) {
    f.triple("centre", g.centre);
    f.required_triple("half_size", g.half_size, Range::positive);
  } else {
    f.required_number("radius", g.radius, Range::positive);
    f.triple("corner", g.corner);
  }
  if (g.kind == GeneratorKind::hexagonal_ball) {
    f.number("gap", g.gap, Range::not_negative);
    f.required_number("ball_radius", g.ball_radius, Range::positive);
  } else if (g.kind == GeneratorKind::grid) {
    read_counts(f, g);
    f.required_triple("spacing", g.spacing);
    f.number("jitter", g.jitter, Range::not_negative);
    f.number("radius_spread", g.radius_spread, Range::below_one);
    f.integer("seed", g.seed, 0, 2147483647);
    f.integer("fixed_layers", g.fixed_layers, 0, 1000);
  }
  scene.generators.push_back(g);
}

void read_facet(Fields& f, Scene& scene) {
  FacetSpec s;
  read_use_of_material(f, scene, s.material);
  const toml::node* node = f.require("vertices");
  const toml::array* array = node == nullptr ? nullptr : node->as_array();
  if (node != nullptr && (array == nullptr || array->size() != 3)) {
    return f.fail(node, "vertices", "must be three points");
  }
  for (std::size_t i = 0; array != nullptr && i < 3; ++i) {
    f.triple_at((*array)[i], f.name_of("vertices[" + std::to_string(i) + "]"), s.vertices[i], Range::any);
  }
  scene.facets.push_back(s);
}

void read_wall(Fields& f, Scene& scene) {
  WallSpec s;
  f.require("axis");
  f.choice<int>("axis", s.axis, {{"x", 0}, {"y", 1}, {"z", 2}});
  f.required_number("position", s.position);
  f.number("velocity", s.velocity);
  read_use_of_material(f, scene, s.material);
  scene.walls.push_back(s);
}

void read_box(Fields& f, Scene& scene) {
  BoxSpec s;
  f.required_triple("centre", s.centre);
  f.required_triple("half_size", s.half_size, Range::positive);
  f.triple("axis", s.axis);
  f.number("angle", s.angle);
  read_use_of_material(f, scene, s.material);
  scene.boxes.push_back(s);
}

void read_contacts(Document& document, Fields& root, Scene& scene) {
  const toml::node* node = root.find("contacts");
  if (node == nullptr) return;
  const toml::table* table = node->as_table();
  if (table == nullptr) return root.fail(node, "contacts", "must be a table");
  Fields f(document, *table, "contacts");
  f.choice<ContactLaw>("law", scene.law,
                       {{"frictional", ContactLaw::frictional},
                        {"viscoelastic", ContactLaw::viscoelastic},
                        {"hertz_mindlin", ContactLaw::hertz_mindlin},
                        {"cohesive", ContactLaw::cohesive}});
  f.choice<ContactsBetween>("between", scene.between,
                            {{"all", ContactsBetween::all}, {"bonded", ContactsBetween::bonded}});
  f.choice<SharedEdges>("shared_edges", scene.shared_edges,
                        {{"once", SharedEdges::once}, {"each", SharedEdges::each}});
  f.number("bond_reach", scene.bond_reach, Range::positive);
  f.number("sweep", scene.sweep, Range::positive);
  f.finish();
}

void read_run(Document& document, Fields& root, Scene& scene) {
  const toml::node* node = root.require("run");
  const toml::table* table = node == nullptr ? nullptr : node->as_table();
  if (table == nullptr) {
    if (node != nullptr) root.fail(node, "run", "must be a table");
    return;
  }
  Fields f(document, *table, "run");
  f.required_number("dt", scene.dt, Range::positive);
  f.required_number("until", scene.until, Range::positive);
  f.triple("gravity", scene.gravity);
  f.number("damping", scene.damping, Range::below_one);
  f.choice<MassRule>("mass", scene.mass_rule, {{"full", MassRule::full}, {"yade", MassRule::yade}});
  f.choice<ConstantsRule>(
      "constants", scene.constants_rule,
      {{"rounded_once", ConstantsRule::rounded_once}, {"stepwise", ConstantsRule::stepwise}});
  f.strings("record", scene.record);
  for (const std::string& r : scene.record) {
    if (std::find(recordable.begin(), recordable.end(), r) == recordable.end()) {
      f.fail(f.find("record"), "record", "nothing named '" + r + "' can be recorded");
    }
  }
  f.number("record_every", scene.record_every, Range::positive);
  f.finish();
}

// The number of spheres that stand before the generators, which is what bonds may name.
void read_bonds(Document& document, Fields& root, Scene& scene) {
  each_table(document, root, "bond", [&](Fields& f) {
    Bond bond;
    const toml::node* node = f.require("bodies");
    const toml::array* array = node == nullptr ? nullptr : node->as_array();
    if (node == nullptr) return;
    if (array == nullptr || array->size() != 2 || !(*array)[0].is_integer() || !(*array)[1].is_integer()) {
      return f.fail(node, "bodies", "must be two body numbers");
    }
    const auto count = static_cast<std::int64_t>(scene.spheres.size());
    const std::int64_t a = (*array)[0].as_integer()->get();
    const std::int64_t b = (*array)[1].as_integer()->get();
    if (a == b || a < 0 || b < 0 || a >= count || b >= count) {
      return f.fail(node, "bodies",
                    "must be two of the " + std::to_string(count) + " spheres, numbered from 0");
    }
    bond.first = static_cast<int>(std::min(a, b));
    bond.second = static_cast<int>(std::max(a, b));
    for (const Bond& other : scene.bonds) {
      if (other.first == bond.first && other.second == bond.second)
        f.fail(node, "bodies", "are bonded twice");
    }
    scene.bonds.push_back(bond);
  });
}

}  // namespace

std::string SceneError::text() const {
  std::string out = file;
  if (line > 0) out += ":" + std::to_string(line);
  if (!key.empty()) out += ": " + key;
  return out + ": " + message;
}

ReadResult read_scene(std::string_view text, std::string_view file) {
  Document document;
  document.file = file;
  std::istringstream stream{std::string(text)};
  for (std::string line; std::getline(stream, line);) document.lines.push_back(line);
  toml::table table;
  try {
    table = toml::parse(text, file);
  } catch (const toml::parse_error& e) {
    return {std::nullopt,
            {{std::string(file), static_cast<int>(e.source().begin.line), "", std::string(e.description())}}};
  }
  Scene scene;
  Fields root(document, table, "");
  read_name(root, scene);
  root.string("title", scene.title);
  read_constants(document, root, scene);
  each_table(document, root, "material", [&](Fields& f) { read_material(f, scene); });
  if (scene.materials.empty()) root.fail(nullptr, "material", "a scene needs one material at least");
  each_table(document, root, "sphere", [&](Fields& f) { read_sphere(f, scene); });
  each_table(document, root, "generator", [&](Fields& f) { read_generator(f, scene); });
  each_table(document, root, "facet", [&](Fields& f) { read_facet(f, scene); });
  each_table(document, root, "wall", [&](Fields& f) { read_wall(f, scene); });
  each_table(document, root, "box", [&](Fields& f) { read_box(f, scene); });
  if (scene.spheres.empty() && scene.generators.empty())
    root.fail(nullptr, "sphere", "a scene needs one body at least");
  read_bonds(document, root, scene);
  read_contacts(document, root, scene);
  if ((!scene.bonds.empty() || scene.bond_reach) && scene.law != ContactLaw::cohesive) {
    root.fail(root.find("contacts"), "contacts.law", "bonds need the law 'cohesive'");
  }
  read_run(document, root, scene);
  root.finish();
  if (!document.errors.empty()) return {std::nullopt, std::move(document.errors)};
  return {std::move(scene), {}};
}

}  // namespace ulpgate::scenes
