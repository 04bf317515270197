#include "coupling/io/vdb_archive.h"

#include <fmt/format.h>
#include <openvdb/io/Archive.h>

#include <fstream>

#include "base/error.h"
#include "coupling/io/atomic_file.h"

namespace interstice::io {
namespace {

class Archive : public openvdb::io::Archive {
 public:
  // Values of active voxels only, as they are: digits of fractions hardly compress. Blosc would take a
  // sixteenth off a dense bed's file and more than double the time of writing it.
  Archive() {
    setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);
    setGridStatsMetadataEnabled(false);  // the grids bring theirs along
  }

  void write_to(std::ostream& out, const openvdb::GridCPtrVec& grids,
                const openvdb::MetaMap& metadata) const {
    constexpr bool seekable = true;  // with the offsets that File::readGrid jumps by
    openvdb::io::Archive::write(out, grids, seekable, metadata);
  }
};

}  // namespace

void add_statistics(openvdb::GridBase& grid, const openvdb::GridCPtrVec& before) {
  const auto* own = dynamic_cast<const openvdb::FloatGrid*>(&grid);
  for (const auto& other : before) {
    const auto* same = dynamic_cast<const openvdb::FloatGrid*>(other.get());
    if (!own || !same || !own->tree().hasSameTopology(same->tree())) continue;
    const openvdb::MetaMap::Ptr statistics = same->getStatsMetadata();
    for (auto entry = statistics->beginMeta(); entry != statistics->endMeta(); ++entry)
      grid.insertMeta(entry->first, *entry->second);
    return;
  }
  grid.addStatsMetadata();
}

void write_grids(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                 const openvdb::MetaMap& metadata) {
  write_atomically(path, [&](const std::filesystem::path& aside) {
    std::ofstream out(aside, std::ios::binary | std::ios::trunc);
    Archive().write_to(out, grids, metadata);
    out.close();
    if (!out) throw RunError(fmt::format("cannot write {}: the disk may be full", path.string()));
  });
}

}  // namespace interstice::io
