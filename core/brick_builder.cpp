#include "core/brick_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "core/morton.h"
#include "core/overlap.h"

namespace dmpc::core {
namespace {

/// A nested brick pays when a ray that crosses it meets clearly fewer primitives: it passes about three of its occupied voxels,
/// each with the mean count, against all of them. Coincident or very large primitives lie in most voxels alike and fail this at
/// once.
constexpr double voxels_crossed = 3.0;
constexpr double worthwhile_share = 0.6;
constexpr std::size_t sample_size = 256;

Corner voxel_corner(const Corner& corner, int voxel_level, std::size_t voxel) {
  const std::int32_t span = span_of(voxel_level);
  const auto at = [&](std::size_t shift) { return static_cast<std::int32_t>(voxel >> shift & 3U) * span; };
  return {corner[0] + at(0), corner[1] + at(2), corner[2] + at(4)};
}

std::uint64_t quantised(double value, double low, double high) {
  return static_cast<std::uint64_t>(std::clamp((value - low) / (high - low), 0.0, 1.0) * 1023.0);
}

}  // namespace

BrickBuilder::BrickBuilder(std::span<const PrimitiveValues> primitives, std::span<const ShadingReference> shading, double pad,
                           float finest_cell, int voxel_primitives_max, RecordWriter& writer)
    : primitives_(primitives),
      shading_(shading),
      pad_(pad),
      finest_cell_(double{finest_cell}),
      voxel_primitives_max_(static_cast<std::size_t>(voxel_primitives_max)),
      writer_(&writer),
      places_(primitives.size()),
      block_of_(primitives.size()) {}

Address BrickBuilder::build_top(const Corner& corner, std::span<const std::uint32_t> ids) {
  return build(0, corner, split(0, corner, ids));
}

/// Sorts the primitives of the cell at `corner` into its 64 voxels.
VoxelLists BrickBuilder::split(int level, const Corner& corner, std::span<const std::uint32_t> ids) const {
  const double edge = span_of(level + 1) * finest_cell_;
  const Vec3d low{corner[0] * finest_cell_, corner[1] * finest_cell_, corner[2] * finest_cell_};
  const Vec3d half{edge / 2 + pad_, edge / 2 + pad_, edge / 2 + pad_};
  std::vector<std::pair<std::uint8_t, std::uint32_t>> found;
  for (const std::uint32_t id : ids) {
    const Overlap overlap(primitives_[id]);
    const Box box = bounds_of(primitives_[id]).padded({pad_, pad_, pad_});
    int first[3], last[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = static_cast<int>(std::clamp(std::floor((box.low[axis] - low[axis]) / edge), 0.0, 3.0));
      last[axis] = static_cast<int>(std::clamp(std::floor((box.high[axis] - low[axis]) / edge), 0.0, 3.0));
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          if (overlap.touches(low + Vec3d{x + 0.5, y + 0.5, z + 0.5} * edge, half)) {
            found.emplace_back(static_cast<std::uint8_t>(x + 4 * y + 16 * z), id);
          }
        }
      }
    }
  }
  VoxelLists lists;
  for (const auto& [voxel, id] : found) {
    ++lists.start[voxel + 1U];
  }
  for (std::size_t voxel = 0; voxel < 64; ++voxel) {
    lists.start[voxel + 1] += lists.start[voxel];
  }
  lists.ids.assign(found.size(), 0U);
  auto next = lists.start;
  for (const auto& [voxel, id] : found) {
    lists.ids[next[voxel]++] = id;
  }
  return lists;
}

bool BrickBuilder::worth_nesting(int voxel_level, std::span<const std::uint32_t> ids, const VoxelLists& inner) const {
  std::size_t occupied = 0;
  for (std::size_t voxel = 0; voxel < 64; ++voxel) {
    occupied += inner.of(voxel).empty() ? 0 : 1;
  }
  const double mean = static_cast<double>(inner.ids.size()) / static_cast<double>(std::max<std::size_t>(occupied, 1));
  return voxel_level < finest_level && voxels_crossed * mean <= worthwhile_share * static_cast<double>(ids.size());
}

/// The same judged from a sample, so that long lists which nesting does not shorten cost no time.
bool BrickBuilder::promising(int voxel_level, const Corner& corner, std::span<const std::uint32_t> ids) const {
  if (ids.size() < 4 * sample_size) {
    return true;
  }
  std::vector<std::uint32_t> sample;
  for (std::size_t i = 0; i < sample_size; ++i) {
    sample.push_back(ids[i * ids.size() / sample_size]);
  }
  return worth_nesting(voxel_level, sample, split(voxel_level, corner, sample));
}

/// Writes the brick of the cell of `level` at `corner`, then its blocks, further sheets and nested bricks.
Address BrickBuilder::build(int level, const Corner& corner, const VoxelLists& lists) {
  struct Nested {
    std::size_t voxel;
    VoxelLists lists;
  };
  std::vector<Nested> nested;
  std::vector<std::uint32_t> ids;
  Brick brick;
  for (std::size_t voxel = 0; voxel < 64; ++voxel) {
    const auto list = lists.of(voxel);
    if (list.empty()) {
      continue;
    }
    brick.occupied |= std::uint64_t{1} << voxel;
    if (list.size() > voxel_primitives_max_ && level + 1 < finest_level &&
        promising(level + 1, voxel_corner(corner, level + 1, voxel), list)) {
      VoxelLists inner = split(level + 1, voxel_corner(corner, level + 1, voxel), list);
      if (worth_nesting(level + 1, list, inner)) {
        brick.nested |= std::uint64_t{1} << voxel;
        nested.push_back({voxel, std::move(inner)});
        continue;
      }
    }
    ids.insert(ids.end(), list.begin(), list.end());
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  const Vec3d low{corner[0] * finest_cell_, corner[1] * finest_cell_, corner[2] * finest_cell_};
  const double edge = span_of(level) * finest_cell_;
  sort_for_blocks({low, low + Vec3d{edge, edge, edge}}, ids);

  const std::vector<Sheet> sheets = cut_into_sheets(lists, brick.nested, ids);
  brick.next_sheet = no_address;
  const Address address = writer_->allocate(sheet_bytes(brick.occupied, brick.nested, sheets[0]));
  std::vector<Address> children;
  std::vector<Address> blocks = write_blocks(sheets[0]);
  if (sheets.size() > 1) {
    brick.next_sheet = write_further_sheets(sheets);
  }
  for (const Nested& inner : nested) {
    children.push_back(build(level + 1, voxel_corner(corner, level + 1, inner.voxel), inner.lists));
  }
  write_sheet(address, brick, sheets[0], blocks, children);
  return address;
}

/// Groups sorted ids into blocks of one kind, up to 8 blocks a sheet, and notes which voxel each block has a primitive in.
std::vector<BrickBuilder::Sheet> BrickBuilder::cut_into_sheets(const VoxelLists& lists, std::uint64_t nested,
                                                               std::span<std::uint32_t> ids) {
  std::vector<Sheet> sheets(1);
  std::uint32_t block_count = 0;
  for (std::size_t first = 0; first < ids.size(); ++block_count) {
    std::size_t last = first;
    while (last < ids.size() && last - first < block_lanes && primitives_[ids[last]].kind == primitives_[ids[first]].kind) {
      block_of_[ids[last++]] = block_count;
    }
    if (block_count > 0 && block_count % blocks_per_sheet == 0) {
      sheets.emplace_back();
    }
    const auto block = ids.subspan(first, last - first);
    std::sort(block.begin(), block.end());
    sheets.back().blocks.push_back(block);
    first = last;
  }
  for (std::size_t voxel = 0; voxel < 64; ++voxel) {
    if ((nested >> voxel & 1U) == 0) {
      for (const std::uint32_t id : lists.of(voxel)) {
        auto& mask = sheets[block_of_[id] / blocks_per_sheet].mask[voxel];
        mask = static_cast<std::uint8_t>(mask | 1U << block_of_[id] % blocks_per_sheet);
      }
    }
  }
  return sheets;
}

std::size_t BrickBuilder::sheet_bytes(std::uint64_t occupied, std::uint64_t nested, const Sheet& sheet) {
  const auto links = sheet.blocks.size() + static_cast<std::size_t>(std::popcount(nested));
  return sizeof(Brick) + links * sizeof(Address) + static_cast<std::size_t>(std::popcount(occupied & ~nested));
}

std::vector<Address> BrickBuilder::write_blocks(const Sheet& sheet) {
  std::vector<Address> blocks;
  for (const auto ids : sheet.blocks) {
    blocks.push_back(write_block(ids));
  }
  return blocks;
}

/// All sheets but the first, chained; returns the second one's address.
Address BrickBuilder::write_further_sheets(std::span<const Sheet> sheets) {
  Address next = no_address;
  for (std::size_t i = sheets.size() - 1; i > 0; --i) {
    Brick brick;
    for (std::size_t voxel = 0; voxel < 64; ++voxel) {
      brick.occupied |= std::uint64_t{sheets[i].mask[voxel] != 0} << voxel;
    }
    brick.next_sheet = next;
    next = writer_->allocate(sheet_bytes(brick.occupied, 0, sheets[i]));
    const std::vector<Address> blocks = write_blocks(sheets[i]);
    write_sheet(next, brick, sheets[i], blocks, {});
  }
  return next;
}

void BrickBuilder::write_sheet(Address address, Brick brick, const Sheet& sheet, std::span<const Address> blocks,
                               std::span<const Address> children) {
  brick.block_count = static_cast<std::uint8_t>(blocks.size());
  writer_->write(address, 0, brick);
  std::size_t offset = sizeof(Brick);
  writer_->write(address, offset, std::as_bytes(blocks));
  offset += blocks.size_bytes();
  writer_->write(address, offset, std::as_bytes(children));
  offset += children.size_bytes();
  for (std::size_t voxel = 0; voxel < 64; ++voxel) {
    if ((brick.occupied & ~brick.nested) >> voxel & 1U) {
      writer_->write(address, offset++, sheet.mask[voxel]);
    }
  }
}

/// Kinds apart, then neighbours in space together.
void BrickBuilder::sort_for_blocks(const Box& box, std::vector<std::uint32_t>& ids) const {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  keyed.reserve(ids.size());
  for (const std::uint32_t id : ids) {
    const Vec3d center = bounds_of(primitives_[id]).center();
    const std::uint64_t code = morton_code(quantised(center.x, box.low.x, box.high.x), quantised(center.y, box.low.y, box.high.y),
                                           quantised(center.z, box.low.z, box.high.z));
    keyed.emplace_back(std::uint64_t{static_cast<std::uint8_t>(primitives_[id].kind)} << 60U | code, id);
  }
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ids[i] = keyed[i].second;
  }
}

Address BrickBuilder::write_block(std::span<const std::uint32_t> ids) {
  const PrimitiveKind kind = primitives_[ids[0]].kind;
  const std::size_t count = ids.size();
  const Address address = writer_->allocate(block_bytes(kind, count));
  BlockHeader header;
  header.kind = kind;
  header.count = static_cast<std::uint8_t>(count);
  writer_->write(address, 0, header);
  const auto at = [&](std::size_t row, std::size_t lane) { return sizeof(BlockHeader) + 4 * (row * count + lane); };
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::uint32_t id = ids[lane];
    for (std::size_t row = 0; row < value_count(kind); ++row) {
      writer_->write(address, at(row, lane), primitives_[id].value[row]);
    }
    writer_->write(address, at(value_count(kind), lane), id);
    writer_->write(address, at(value_count(kind) + 1, lane), shading_[id]);
    places_[id] = {address, static_cast<std::uint32_t>(lane)};
  }
  references_ += count;
  return address;
}

}  // namespace dmpc::core
