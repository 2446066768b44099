#include "apps/scene/database_options.h"

#include <bit>

#include "apps/edge/line/option_values.h"
#include "core/base/expect.h"

namespace dmpc::apps {

const char* name_of(AxesChoice axes) { return axes == AxesChoice::screen ? "screen" : "world"; }

const char* name_of(core::RecordOrder order) { return order == core::RecordOrder::scattered ? "scattered" : "spatial"; }

const char* name_of(core::Structure structure) { return structure == core::Structure::extents ? "extents" : "grid"; }

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
       .help = "Size of a page, a power of two from 512B to 64KiB; no record crosses its border"},
      {.name = "--record-order",
       .takes = word<&DatabaseOptions::build, &BuildOptions::record_order>(
           OptionSet::Choices<RecordOrder>{{"spatial", RecordOrder::spatial}, {"scattered", RecordOrder::scattered}}),
       .help = "Which records share a page: neighbours in space, or any (another traffic, the same picture)"},
      {.name = "--structure",
       .takes = word<&DatabaseOptions::build, &BuildOptions::structure>(
           OptionSet::Choices<Structure>{{"grid", Structure::grid}, {"extents", Structure::extents}}),
       .help =
           "How records are found: by a grid whose cells have trees of boxes, or by one tree of boxes over all (another traffic, "
           "the same picture)"},
      {.name = "--grid-axes",
       .takes = word<&DatabaseOptions::axes>(
           OptionSet::Choices<AxesChoice>{{"world", AxesChoice::world}, {"screen", AxesChoice::screen}}),
       .help = "Directions of the grid, and so of dataflow's regions"}};
  return rows;
}

void add_options(OptionSet options, DatabaseOptions& database) {
  for (const DatabaseRow& row : database_rows()) {
    row.add_to(options, database);
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
