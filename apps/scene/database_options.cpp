#include "apps/scene/database_options.h"

#include <bit>

#include "apps/frontend/line/option_values.h"
#include "core/base/expect.h"

namespace dmpc::apps {

const char* name_of(core::RecordOrder order) { return order == core::RecordOrder::scattered ? "scattered" : "spatial"; }

const char* name_of(core::Structure structure) { return core::structure_names[static_cast<std::size_t>(structure)].data(); }

const std::vector<DatabaseRow>& database_rows() {
  using core::BuildOptions, core::RecordOrder, core::Structure;
  static const std::vector<DatabaseRow> rows = {
      {.name = "--page-size",
       .takes = {core::field_of<&BuildOptions::page_size_bytes>(),
                 [](OptionSet set, const char* name, const char* help, DatabaseOptions& database, const std::string&) {
                   const auto take = [&database](const std::string& text) {
                     database.build.page_size_bytes = parse_page_size(text);
                   };
                   set.add_text(name, "SIZE [1KiB, forest 4KiB]", take, help);
                 }},
       .help = "Page size, a power of two from 512B to 64KiB; no record crosses a page boundary"},
      {.name = "--record-order",
       .takes = word<&DatabaseOptions::build, &BuildOptions::record_order>(
           OptionSet::Choices<RecordOrder>{{"spatial", RecordOrder::spatial}, {"scattered", RecordOrder::scattered}}),
       .help = "Records that share a page: neighbours in space, or any (different traffic, the same picture)"},
      {.name = "--structure",
       .takes = word<&DatabaseOptions::build, &BuildOptions::structure>(OptionSet::Choices<Structure>{
           {"grid", Structure::grid}, {"extents", Structure::extents}, {"voxels", Structure::voxels}}),
       .help = "Acceleration structure: a grid whose cells have bounding volume hierarchies, one bounding volume hierarchy of "
               "the scene, or a plain grid whose voxels have lists (different traffic, the same picture)"},
      {.name = "--voxels",
       .takes = word<&DatabaseOptions::build, &BuildOptions::voxels>(
           OptionSet::Choices<core::VoxelRule>{{"usual", core::usual_voxels}, {"article", core::article_voxels}}),
       .help = "With --structure=voxels: 8 voxels per primitive, at most 256^3; or as in the article 14 per polygon, at most "
               "64^3, polygons of 129 B, no distances"}};
  return rows;
}

void add_options(OptionSet options, DatabaseOptions& database) {
  for (const DatabaseRow& row : database_rows()) {
    row.add_to(options, database);
  }
}

std::string text_of(const core::VoxelRule& rule) { return rule == core::article_voxels ? "article" : "usual"; }

void check_voxels(const OptionSet& options, const core::BuildOptions& build) {
  if (options.is_given("--voxels") && build.structure != core::Structure::voxels) {
    throw core::UsageError(std::string("--voxels does not go with --structure=") + name_of(build.structure) +
                           ": only --structure=voxels has voxels");
  }
}

std::size_t parse_page_size(const std::string& text) {
  const std::size_t bytes = parse_size_bytes(text, "--page-size");
  if (!std::has_single_bit(bytes) || bytes < 512 || bytes > 65536) {
    throw core::UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
  return bytes;
}

}  // namespace dmpc::apps
