#include "core/extract.h"

#include <bit>
#include <cstring>
#include <map>
#include <utility>

#include "core/directory.h"
#include "core/record_writer.h"
#include "core/units.h"

namespace dmpc::core {
namespace {

/// Edge of a directory tile, in finest cells.
constexpr std::int32_t tile_edge = 4 * finest_per_top;
/// Nothing depends on a part's pages; the smallest wastes least at its end.
constexpr std::size_t part_page_bytes = 512;

/// A brick's record, taken apart.
struct BrickView {
  Brick brick;
  const std::byte* links;

  explicit BrickView(const std::byte* record) : brick(read<Brick>(record)), links(record + sizeof(Brick)) {}
  std::size_t child_count() const { return static_cast<std::size_t>(std::popcount(brick.nested)); }
  Address block(std::size_t index) const { return read<Address>(links + index * sizeof(Address)); }
  Address child(std::size_t index) const { return block(brick.block_count + index); }
  std::uint8_t mask(std::size_t rank) const {
    return static_cast<std::uint8_t>(links[(brick.block_count + child_count()) * sizeof(Address) + rank]);
  }
};

Corner voxel_corner(const Corner& cell, int voxel_level, std::size_t voxel) {
  const std::int32_t span = span_of(voxel_level);
  return {cell[0] + static_cast<std::int32_t>(voxel & 3U) * span, cell[1] + static_cast<std::int32_t>(voxel >> 2U & 3U) * span,
          cell[2] + static_cast<std::int32_t>(voxel >> 4U & 3U) * span};
}

/// A voxel that is kept: a nested brick's old address, or a mask of old blocks.
struct KeptVoxel {
  std::size_t voxel;
  bool nested;
  Address child = no_address;
  std::uint8_t mask = 0;
};

class Extractor {
 public:
  Extractor(const Database& database, const Region& region)
      : whole_(database.header()), bytes_(database.bytes().data()), region_(region), writer_(part_page_bytes) {}

  DatabasePart extract() {
    DatabaseHeader& header = part_.header;
    header = whole_;
    header.region = region_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      header.directory_low[axis] = region_.low[axis] / tile_edge * tile_edge;
      header.directory_size[axis] = ceil_divide(region_.high[axis] - header.directory_low[axis], finest_per_top);
    }
    header.directory = writer_.allocate_array<DirectoryEntry>(directory_entry_count(header.directory_size));
    header.lights = copy_array<LightRecord>(whole_.lights, whole_.light_count);
    header.materials = copy_array<MaterialRecord>(whole_.materials, whole_.material_count);
    copy_directory();
    part_.bytes = std::move(writer_).finish();
    return std::move(part_);
  }

 private:
  const std::byte* at(Address address) const { return bytes_ + byte_offset(address); }

  template <class T>
  Address copy_array(Address from, std::size_t count) {
    const Address to = writer_.allocate_array<T>(count);
    if (count > 0) {
      writer_.write(to, 0, std::span(at(from), count * sizeof(T)));
    }
    return to;
  }

  void copy_directory() {
    const DatabaseHeader& header = part_.header;
    Corner cell;
    for (cell[2] = header.directory_low[2]; cell[2] < region_.high[2]; cell[2] += finest_per_top) {
      for (cell[1] = header.directory_low[1]; cell[1] < region_.high[1]; cell[1] += finest_per_top) {
        for (cell[0] = header.directory_low[0]; cell[0] < region_.high[0]; cell[0] += finest_per_top) {
          copy_top_cell(cell);
        }
      }
    }
  }

  void copy_top_cell(const Corner& cell) {
    DirectoryEntry entry = directory_entry(at(directory_address(whole_, cell)), cell);
    if (!entry.empty()) {
      entry.bits = region_.overlaps(cell, finest_per_top) ? static_cast<std::uint32_t>(copy_brick(entry.brick(), cell, 1, true))
                                                          : DirectoryEntry::empty_flag | 1U;
    }
    const auto slot = static_cast<std::size_t>(cell[0] / finest_per_top % 2);
    writer_.write(directory_address(part_.header, cell), slot * sizeof(entry), entry);
  }

  /// The voxels of one sheet that touch the region.
  std::vector<KeptVoxel> kept_voxels(const BrickView& view, const Corner& cell, int voxel_level) const {
    std::vector<KeptVoxel> kept;
    std::size_t child = 0, leaf = 0;
    for (std::size_t voxel = 0; voxel < 64; ++voxel) {
      if ((view.brick.occupied >> voxel & 1U) == 0) {
        continue;
      }
      KeptVoxel found{.voxel = voxel, .nested = (view.brick.nested >> voxel & 1U) != 0};
      if (found.nested) {
        found.child = view.child(child++);
      } else {
        found.mask = view.mask(leaf++);
      }
      if (region_.overlaps(voxel_corner(cell, voxel_level, voxel), span_of(voxel_level))) {
        kept.push_back(found);
      }
    }
    return kept;
  }

  /// Copies the sheet at `from` of the brick of `cell`, and what hangs on it.
  Address copy_brick(Address from, const Corner& cell, int voxel_level, bool first_sheet) {
    const BrickView view(at(from));
    const std::vector<KeptVoxel> kept = kept_voxels(view, cell, voxel_level);
    std::uint8_t used = 0;
    Brick brick;
    for (const KeptVoxel& voxel : kept) {
      used = static_cast<std::uint8_t>(used | voxel.mask);
      brick.occupied |= std::uint64_t{1} << voxel.voxel;
      brick.nested |= std::uint64_t{voxel.nested} << voxel.voxel;
    }
    brick.block_count = static_cast<std::uint8_t>(std::popcount(used));
    const std::size_t links = brick.block_count + static_cast<std::size_t>(std::popcount(brick.nested));
    const auto leaves = static_cast<std::size_t>(std::popcount(brick.occupied & ~brick.nested));
    const Address to = writer_.allocate(sizeof(Brick) + links * sizeof(Address) + leaves);
    std::vector<Address> addresses;
    for (std::size_t block = 0; block < view.brick.block_count; ++block) {
      if ((used >> block & 1U) != 0) {
        addresses.push_back(copy_block(view.block(block)));
      }
    }
    if (view.brick.next_sheet != no_address) {
      brick.next_sheet = copy_brick(view.brick.next_sheet, cell, voxel_level, false);
    }
    for (const KeptVoxel& voxel : kept) {
      if (voxel.nested) {
        addresses.push_back(copy_brick(voxel.child, voxel_corner(cell, voxel_level, voxel.voxel), voxel_level + 1, true));
      }
    }
    expect(first_sheet || brick.nested == 0, "only a brick's first sheet has nested bricks");
    write_brick(to, brick, addresses, kept, used);
    return to;
  }

  void write_brick(Address to, const Brick& brick, std::span<const Address> addresses, std::span<const KeptVoxel> kept,
                   std::uint8_t used) {
    writer_.write(to, 0, brick);
    writer_.write(to, sizeof(Brick), std::as_bytes(addresses));
    std::size_t offset = sizeof(Brick) + addresses.size_bytes();
    for (const KeptVoxel& voxel : kept) {
      if (!voxel.nested) {
        writer_.write(to, offset++, compressed(voxel.mask, used));
      }
    }
  }

  /// The bits of `mask` at the places where `used` has bits, moved together.
  static std::uint8_t compressed(std::uint8_t mask, std::uint8_t used) {
    std::uint32_t result = 0, place = 0;
    for (std::uint32_t bit = 0; bit < blocks_per_sheet; ++bit) {
      if ((used >> bit & 1U) != 0) {
        result |= (static_cast<std::uint32_t>(mask) >> bit & 1U) << place++;
      }
    }
    return static_cast<std::uint8_t>(result);
  }

  Address copy_block(Address from) {
    const auto header = read<BlockHeader>(at(from));
    const std::size_t size = block_bytes(header.kind, header.count), row = sizeof(ShadingReference) * header.count;
    std::vector<ShadingReference> shading(header.count);
    std::memcpy(shading.data(), at(from) + size - row, row);
    for (ShadingReference& reference : shading) {
      if (reference.is_smooth()) {
        reference = ShadingReference::smooth(copy_normals(reference.normals()));
      }
    }
    const Address to = writer_.allocate(size);
    writer_.write(to, 0, std::span(at(from), size - row));
    writer_.write(to, size - row, std::as_bytes(std::span(shading)));
    part_.primitive_copies += header.count;
    return to;
  }

  /// A triangle that lies in several bricks keeps one record of normals.
  Address copy_normals(Address from) {
    const auto [found, is_new] = normals_.try_emplace(static_cast<std::uint32_t>(from), no_address);
    if (is_new) {
      found->second = writer_.allocate(sizeof(PatchNormals));
      writer_.write(found->second, 0, std::span(at(from), sizeof(PatchNormals)));
    }
    return found->second;
  }

  const DatabaseHeader& whole_;
  const std::byte* bytes_;
  Region region_;
  RecordWriter writer_;
  DatabasePart part_;
  std::map<std::uint32_t, Address> normals_;  ///< old address -> new
};

}  // namespace

DatabasePart extract(const Database& database, const Region& region) { return Extractor(database, region).extract(); }

}  // namespace dmpc::core
