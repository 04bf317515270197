// --walls and --solid of `interstice voids`: walls and tools that the particle file does not hold.
#pragma once

#include <string>
#include <vector>

#include "voxel/solids.h"

namespace interstice::apps {

struct WallOptions {
  voxel::Solids solids;
  std::vector<std::string> meshes;  // "blade.stl", in the order of solids.meshes
  std::vector<std::string> words;   // all of them as given
};

/// "FILE.stl@UNIT": reads the file. Throws InputError.
void read_mesh(const std::string& text, WallOptions& options);

/// "box:x0,x1,y0,y1,z0,z1", "ball:x,y,z,RADIUS", "cylinder:x0,y0,z0,x1,y1,z1,RADIUS" (the middles of its
/// ends) or "plane:x,y,z,nx,ny,nz" (solid behind the normal), lengths with units. Throws InputError.
void read_solid(const std::string& text, WallOptions& options);

/// A line for each mesh that lies outside the field's box, or whose size makes its unit unlikely.
std::vector<std::string> warnings_of_walls(const WallOptions& options, const Box& box);

}  // namespace interstice::apps
