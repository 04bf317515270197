// The readers of a scene's sections (internal to this folder). Each takes the document's table and returns
// what it says; what is wrong goes to `problems`, and the returned values are then harmless.
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/document.h"
#include "coupling/scene/scene.h"
#include "coupling/scene/table_reader.h"

namespace interstice::scene {

Domain read_domain(const Value* table, const Place& around, Problems& problems);
std::vector<Material> read_materials(const Value* table, Problems& problems);
Contact read_contact(const Value* table, const Place& around, Problems& problems);
std::vector<Particles> read_particles(const TableReader& root, const std::string& scene_file);
Diameters read_diameters(const Value& value, const std::string& path, Problems& problems);
std::vector<Wall> read_walls(const TableReader& root);
std::vector<Phase> read_phases(const TableReader& root);
TimeStep read_time_step(const TableReader& time);
std::vector<Field> read_fields(const TableReader& root);

/// A placement list in CSV: a header such as "x [um], y [um], z [um], diameter [um], vx [m/s]", then one row
/// a grain. `key` is named in messages where the text stands in the scene itself (then its place is that of
/// the value).
std::vector<PlacedGrain> read_grain_list(std::string_view text, const Place& place, const std::string& key,
                                         Problems& problems);

/// What concerns more than one section: names, references, pairs that can meet, places inside the domain.
void check_scene(const Scene& scene, const Value& document, Problems& problems);

}  // namespace interstice::scene
