#include "core/database/database_parts.h"

#include <bit>
#include <cmath>
#include <initializer_list>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "core/record/directory.h"
#include "core/record/emitter.h"
#include "core/record/records.h"
#include "core/record/sky.h"
#include "core/scene/frame.h"

namespace dmpc::core {
namespace {

void require(bool holds, const char* what) {
  if (!holds) {
    throw InputError(std::string("its ") + what + (holds ? "" : " is impossible"));
  }
}

bool are_finite(std::initializer_list<double> numbers) {
  bool all = true;
  for (const double number : numbers) {
    all = all && std::isfinite(number);
  }
  return all;
}
bool are_finite(const Vec3d& vector) { return are_finite({vector.x, vector.y, vector.z}); }
bool are_finite(const Color& color) { return are_finite(Vec3d(color)); }

/// What tables of a header refer to.
class HeaderCheck {
 public:
  HeaderCheck(const DatabaseSummary& summary, std::uint64_t primitives)
      : summary_(summary), header_(summary.header), primitives_(primitives) {}

  void check() const {
    check_pages();
    check_frame();
    check_counts();
    check_tables();
    check_light();
  }

 private:
  void check_pages() const {
    const DatabaseSummary& all = summary_;
    require(all.page_size >= 512 && all.page_size <= 65536 && std::has_single_bit(all.page_size), "size of a page");
    require(all.page_count > 0 && all.page_count <= (std::uint64_t{1} << 34U) / all.page_size, "number of pages");
    require(all.forest_page_count <= all.page_count && all.open_page_count <= all.page_count - all.forest_page_count,
            "number of pages of a tree");
    require(all.structure <= Structure::voxels && header_.has_voxels() == (all.structure == Structure::voxels) &&
                (all.structure == Structure::extents || all.forest_page_count == 0),
            "structure");
  }

  void check_frame() const {
    constexpr std::int32_t cells_max = 1 << 24;
    const GridFrame& frame = header_.frame;
    for (const std::int32_t cells : frame.resolution) {
      require(cells >= 1 && cells <= cells_max, "number of cells");
    }
    require(are_finite(frame.origin) && are_finite(frame.low) && are_finite(frame.eye_extent) && std::isfinite(frame.scale) &&
                frame.scale > 0 && std::isfinite(frame.finest_cell) && frame.finest_cell > 0,
            "grid");
    require(header_.region == Region{{}, grid_size(frame)} && header_.directory_size == macro_cells(frame) &&
                header_.directory_low == Corner{} && header_.directory_doublings == 0,
            "directory");
    require(std::isfinite(summary_.pad) && summary_.pad > 0, "pad");
  }

  void check_counts() const {
    require(header_.primitive_count >= primitives_ || header_.has_instances == 0, "number of primitives");
    require(header_.has_instances != 0 || header_.primitive_count == primitives_, "number of primitives");
    require((header_.has_instances != 0) == (summary_.records.instances > 0), "number of instances");
    require(header_.material_count >= summary_.records.materials, "number of materials");
  }

  void check_tables() const {
    std::uint64_t entries = directory_entry_count(header_.directory_size);
    require(entries <= std::uint64_t{1} << 32U, "directory");
    require_within(header_.directory, entries * sizeof(DirectoryEntry), "directory");
    if (header_.has_voxels()) {
      require_within(header_.references, summary_.records.voxel_references, sizeof(VoxelReference), "lists of voxels");
    }
    require_within(header_.materials, header_.material_count, sizeof(MaterialRecord), "table of materials");
    require_within(header_.lights, header_.light_count, sizeof(LightRecord), "table of lights");
    if (has_emitters(header_)) {
      require_within(header_.emitters, header_.emitter_count, sizeof(EmitterRecord) + sizeof(EmitterChoice), "table of emitters");
    }
    if (has_sky_picture(header_)) {
      require_within(header_.sky.tiles, sky_tile_count(header_.sky), sizeof(TextureTile), "sky");
      require_within(header_.sky.choices, sky_tile_count(header_.sky), sizeof(EmitterChoice), "sky");
    }
  }

  void check_light() const {
    const SkyReference& sky = header_.sky;
    require(are_finite(header_.background) && are_finite(header_.ambient), "background");
    require(!has_emitters(header_) || (std::isfinite(header_.emitter_density) && header_.emitter_density > 0 &&
                                       header_.drawn_materials <= header_.material_count),
            "table of emitters");
    require(!has_sky_picture(header_) || (sky.width > 0 && sky.height > 0 && are_finite({sky.scale, sky.density}) &&
                                          are_finite({sky.least_strength}) && are_finite(sky.middle) && are_finite(sky.up)),
            "sky");
  }

  void require_within(Address table, std::uint64_t count, std::uint64_t item_bytes, const char* what) const {
    require_within(table, count > std::uint64_t{1} << 33U ? ~std::uint64_t{0} : count * item_bytes, what);
  }
  void require_within(Address table, std::uint64_t bytes, const char* what) const {
    const std::uint64_t all = summary_.page_count * summary_.page_size, first = byte_offset(table);
    require(first <= all && bytes <= all - first, what);
  }

  const DatabaseSummary& summary_;
  const DatabaseHeader& header_;
  std::uint64_t primitives_;
};

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
  HeaderCheck(summary, primitives.items().size()).check();
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
