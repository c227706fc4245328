// Lines of the files that scenes and integrators leave: what reports/schema says of them, checked here.
#pragma once

#include "harness/app/reading/run_context.hpp"

namespace ulpgate::app {

// One kind of file: its name and what each of its lines is.
struct LineKind {
  std::string_view file;
  std::span<const Field> fields;
  // What one line alone may have: two with the same values are a duplicate.
  std::span<const std::string_view> key;
  // What is wrong between the fields of one line; empty where nothing is.
  std::string (*contradiction)(const Json& line);
};

extern const LineKind scene_lines;        // scenes.jsonl
extern const LineKind correlation_lines;  // correlation.jsonl
extern const LineKind order_lines;        // orders.jsonl
extern const LineKind drift_lines;        // drift.jsonl

struct PlacedRow {
  std::string place;  // "DIR/scenes.jsonl:3"
  Json row;           // has the fields of its kind, each of its type
};

// The lines of DIR/FILE, each held to its kind and to the plan of the context; the file must be what the run
// wrote.  Throws a Failure that names file and line.
[[nodiscard]] std::vector<PlacedRow> read_rows(const std::filesystem::path& directory, const Json& context,
                                               const LineKind& kind);

// What a run of scenes left.
struct SceneRows {
  Json context;
  std::vector<PlacedRow> scenes;
  std::vector<PlacedRow> correlations;  // none where nothing was correlated
};
// Throws a Failure as read_rows does; incomplete where the context says that the run is complete and a type
// of it has no row.
[[nodiscard]] SceneRows read_scene_rows(const std::filesystem::path& directory);

}  // namespace ulpgate::app
