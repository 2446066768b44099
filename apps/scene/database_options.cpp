#include "apps/scene/database_options.h"

#include <bit>

#include "apps/edge/line/option_values.h"
#include "core/base/expect.h"

namespace dmpc::apps {

const char* name_of(AxesChoice axes) { return axes == AxesChoice::screen ? "screen" : "world"; }

const char* name_of(core::RecordOrder order) { return order == core::RecordOrder::scattered ? "scattered" : "spatial"; }

const char* name_of(core::Structure structure) { return structure == core::Structure::extents ? "extents" : "grid"; }

void add_options(OptionSet options, DatabaseOptions& database) {
  options.add_text(
      "--page-size", "SIZE [1KiB, forest 4KiB]",
      [&database](const std::string& text) { database.build.page_size_bytes = parse_page_size(text); },
      "Size of a page, a power of two from 512B to 64KiB; no record crosses its border");
  using core::RecordOrder;
  options.add_choice<RecordOrder>("--record-order", database.build.record_order,
                                  {{"spatial", RecordOrder::spatial}, {"scattered", RecordOrder::scattered}},
                                  "Which records share a page: neighbours in space, or any (another traffic, the same picture)");
  using core::Structure;
  options.add_choice<Structure>("--structure", database.build.structure,
                                {{"grid", Structure::grid}, {"extents", Structure::extents}},
                                "How records are found: by a grid whose cells have trees of boxes, or by one tree of boxes over "
                                "all (another traffic, the same picture)");
  options.add_choice<AxesChoice>("--grid-axes", database.axes, {{"world", AxesChoice::world}, {"screen", AxesChoice::screen}},
                                 "Directions of the grid, and so of dataflow's regions");
}

std::size_t parse_page_size(const std::string& text) {
  const std::size_t bytes = parse_size_bytes(text, "--page-size");
  if (!std::has_single_bit(bytes) || bytes < 512 || bytes > 65536) {
    throw core::UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
  return bytes;
}

}  // namespace dmpc::apps
