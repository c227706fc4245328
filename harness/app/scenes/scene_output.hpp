// What a scene run writes: records, series, snapshots, ParaView files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/app/store/records.hpp"
#include "harness/core/collisions/collision_summary.hpp"
#include "harness/core/scenes/scene_compare.hpp"

namespace ulpgate::app {

[[nodiscard]] std::array<double, 3> mean_position(const dem::DemEngine& engine);
// Of every bit of positions, velocities and angular velocities.
[[nodiscard]] std::uint64_t state_hash(const dem::DemEngine& engine);
// body,shape,x_m,y_m,z_m,radius_m,kinetic_J,time_s; kinetic_J is of translation alone, from the velocities as
// the state holds them.
[[nodiscard]] std::string snapshot_csv(const dem::DemEngine& engine);
// Legacy VTK, ASCII: spheres as points with radius, speed and kinetic energy, facets as triangles.
[[nodiscard]] std::string vtk_text(const dem::DemEngine& engine, const std::string& title);
[[nodiscard]] std::string divergence_csv(const std::vector<Divergence>& rows);
// step,only_in,first_body,second_body: every contact that only one of the two simulations has.
[[nodiscard]] std::string contact_differences_csv(const std::vector<Divergence>& rows);
// " 3-7 4-9", the first few.
[[nodiscard]] std::string pair_names(const std::vector<dem::BodyPair>& pairs);
// The energy account as an object (names of DemEngine::energy_names, J), null where none is kept.
[[nodiscard]] Json energy_json(const dem::DemEngine& engine);

inline constexpr const char* collision_records_file = "collisions.jsonl";
// A line of collisions.jsonl of each collision, and of all that a run had.
[[nodiscard]] Json collision_json(const dem::CollisionRecord& r);
[[nodiscard]] Json ledger_json(const CollisionSummary& s, std::uint64_t rows);
// The totals as they are held in a checkpoint: every number comes back as it was.
[[nodiscard]] Json state_json(const CollisionSummary& s);
[[nodiscard]] CollisionSummary summary_of(const Json& state);
// "4 collisions ended, 0 are open ...", two lines.
[[nodiscard]] std::string summary_text(const CollisionSummary& s);

}  // namespace ulpgate::app
