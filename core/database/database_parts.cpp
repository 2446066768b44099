#include "core/database/database_parts.h"

#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "core/record/choice_node.h"
#include "core/record/directory.h"
#include "core/record/emitter.h"
#include "core/record/records.h"
#include "core/record/sky.h"
#include "core/scene/frame.h"

namespace dmpc::core {
namespace {

void require(bool holds, const char* what) {
  if (!holds) {
    throw InputError(std::string("its ") + what + " is impossible");
  }
}

bool are_finite(const Vec3d& vector) { return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z); }

void check_pages(const DatabaseSummary& all) {
  require(all.page_size >= 512 && all.page_size <= 65536 && std::has_single_bit(all.page_size), "size of a page");
  require(all.page_count > 0 && all.page_count <= (std::uint64_t{1} << 34U) / all.page_size, "number of pages");
  require(all.forest_page_count <= all.page_count && all.open_page_count <= all.page_count - all.forest_page_count,
          "number of pages of a tree");
  require(all.structure <= Structure::voxels && all.header.has_voxels() == (all.structure == Structure::voxels) &&
              (all.structure == Structure::extents || all.forest_page_count == 0),
          "structure");
}

void check_grid(const DatabaseSummary& all) {
  constexpr std::int32_t cells_max = 1 << 24;
  const DatabaseHeader& header = all.header;
  const GridFrame& frame = header.frame;
  for (const std::int32_t cells : frame.resolution) {
    require(cells >= 1 && cells <= cells_max, "number of cells");
  }
  require(are_finite(frame.origin) && are_finite(frame.low) && are_finite(frame.eye_extent) && std::isfinite(frame.scale) &&
              frame.scale > 0 && std::isfinite(frame.finest_cell) && frame.finest_cell > 0,
          "grid");
  require(header.region == Region{{}, grid_size(frame)} && header.directory_size == macro_cells(frame) &&
              header.directory_low == Corner{} && header.directory_doublings == 0,
          "directory");
  require(std::isfinite(all.pad) && all.pad > 0, "pad");
}

void check_counts(const DatabaseSummary& all, std::uint64_t primitives) {
  const DatabaseHeader& header = all.header;
  require(header.has_instances != 0 ? header.primitive_count >= primitives : header.primitive_count == primitives,
          "number of primitives");
  require((header.has_instances != 0) == (all.records.instances > 0), "number of instances");
  require(header.material_count >= all.records.materials, "number of materials");
  require(are_finite(Vec3d(header.background)) && are_finite(Vec3d(header.ambient)), "background");
}

/// Each lies in the pages.
void check_tables(const DatabaseSummary& all) {
  const DatabaseHeader& header = all.header;
  const auto check = [end = all.page_count * all.page_size](Address table, std::uint64_t count, std::uint64_t bytes,
                                                            const char* what) {
    const std::uint64_t first = byte_offset(table);
    require(first <= end && count <= end && count * bytes <= end - first, what);
  };
  check(header.directory, directory_entry_count(header.directory_size), sizeof(DirectoryEntry), "directory");
  if (header.has_voxels()) {
    check(header.references, all.records.voxel_references, sizeof(VoxelReference), "lists of voxels");
  }
  check(header.materials, header.material_count, sizeof(MaterialRecord), "table of materials");
  check(header.lights, header.light_count, sizeof(LightRecord), "table of lights");
  if (has_emitters(header)) {
    check(header.emitters, header.emitter_count, sizeof(EmitterRecord), "table of emitters");
    check(choice_address(header, 0), choice_node_count(header.emitter_count), sizeof(ChoiceNode), "choices of emitters");
  }
  if (has_sky_picture(header)) {
    require(header.sky.width > 0 && header.sky.height > 0 && are_finite(header.sky.middle) && are_finite(header.sky.up), "sky");
    check(header.sky.tiles, sky_tile_count(header.sky), sizeof(TextureTile), "sky");
    check(header.sky.choices, choice_node_count(sky_tile_count(header.sky)), sizeof(ChoiceNode), "choices of the sky");
  }
}

}  // namespace

DatabaseParts DatabaseParts::of(const Database& database) {
  expect(!database.bytes().empty() && database.bytes_.items().size() > database.bytes().size(), "a database has its records");
  DatabaseSummary summary{.header = database.header_,
                          .structure = database.structure_,
                          .page_size = database.page_size_,
                          .page_count = database.page_count_,
                          .forest_page_count = database.forest_page_count_,
                          .open_page_count = database.open_page_count_,
                          .dropped = database.dropped_,
                          .duplicates = database.duplicates_,
                          .shared_planes = database.shared_planes_,
                          .references = database.references_,
                          .records = database.records_,
                          .pad = database.pad_};
  for (const auto& [obstacle, places] : database.records_.copied) {
    summary.copied.at(static_cast<std::size_t>(obstacle)) = places;
  }
  return {summary,          database.bytes_,     database.primitives_, database.sources_,
          database.planes_, database.collapsed_, database.close_faces_};
}

Database DatabaseParts::assembled() && {
  check_pages(summary);
  check_grid(summary);
  check_counts(summary, primitives.items().size());
  check_tables(summary);
  require(records.items().size() == summary.page_count * summary.page_size + overread_bytes, "number of pages");
  require(sources.items().size() == primitives.items().size(), "number of primitives");
  Database result;
  result.header_ = summary.header;
  result.structure_ = summary.structure;
  result.page_size_ = summary.page_size;
  result.page_count_ = summary.page_count;
  result.forest_page_count_ = summary.forest_page_count;
  result.open_page_count_ = summary.open_page_count;
  result.dropped_ = summary.dropped;
  result.duplicates_ = summary.duplicates;
  result.shared_planes_ = summary.shared_planes;
  result.references_ = summary.references;
  static_cast<UniformRecordCounts&>(result.records_) = summary.records;
  for (std::size_t i = 0; i < summary.copied.size(); ++i) {
    if (summary.copied[i] > 0) {
      result.records_.copied[static_cast<Obstacle>(i)] = summary.copied[i];
    }
  }
  result.pad_ = summary.pad;
  result.bytes_ = std::move(records);
  result.primitives_ = std::move(primitives);
  result.sources_ = std::move(sources);
  result.planes_ = std::move(planes);
  result.collapsed_ = std::move(collapsed);
  result.close_faces_ = std::move(close_faces);
  return result;
}

}  // namespace dmpc::core
