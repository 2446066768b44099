#include "apps/lab/study/paper/tables.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/filled_columns.h"
#include "core/base/expect.h"
#include "core/record/record.h"

namespace dmpc::apps {
namespace {

std::optional<CellOfTable3> table_3_cell_of(const Catalogue& catalogue, const PaperResults& results, std::size_t scene,
                                            std::size_t column) {
  const PaperScene& paper = paper_scenes[scene];
  const std::size_t base = paper.base();
  const auto found = column < base ? std::nullopt : found_efficiency(catalogue.timed[scene], results, base, column);
  if (!found) {
    return std::nullopt;
  }
  const PaperResult& result = *results[catalogue.timed[scene][column]];
  const auto& alone = results[catalogue.one_worker[scene]];
  return CellOfTable3{.scene = scene,
                      .title = paper.title,
                      .nodes = paper_node_counts[column],
                      .printed_seconds = static_cast<double>(paper.seconds[column]),
                      .seconds = result.seconds(),
                      .printed_efficiency = printed_efficiency(paper, column),
                      .efficiency = *found,
                      .one_worker_seconds = alone ? std::optional(alone->seconds()) : std::nullopt,
                      .is_calibrated = scene == calibration_row && column < calibration_cell_count,
                      .is_base = column == base,
                      .parts = result.parts};
}

Differences differences_of(const Catalogue& catalogue, const PaperResults& results) {
  Differences errors;
  for (const CellOfTable3& cell : cells_of_table_3(catalogue, results)) {
    if (cell.is_predicted()) {
      errors.add(cell.efficiency - cell.printed_efficiency);
    }
  }
  return errors;
}

}  // namespace

std::optional<double> found_efficiency(const Catalogue::ByNodeCount& runs, const PaperResults& results, std::size_t base,
                                       std::size_t column) {
  const auto &first = results[runs[base]], &result = results[runs[column]];
  if (!first || !result) {
    return std::nullopt;
  }
  return efficiency(first->seconds(), paper_node_counts[base], result->seconds(), paper_node_counts[column]);
}

std::size_t printed_cell_count() {
  std::size_t count = 0;
  for (const PaperScene& scene : paper_scenes) {
    count += paper_node_counts.size() - scene.base();
  }
  return count;
}

void note_missing_rows(Table& table, std::size_t expected) {
  core::expect(table.rows().size() <= expected, "a table has no more rows than it can have");
  if (const std::size_t missing = expected - table.rows().size(); missing > 0) {
    table.add_note("Unfinished: " + std::to_string(missing) + " of " + std::to_string(expected) + " rows are missing.");
  }
}

std::vector<CellOfTable3> cells_of_table_3(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<CellOfTable3> cells;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      if (const auto cell = table_3_cell_of(catalogue, results, scene, column)) {
        cells.push_back(*cell);
      }
    }
  }
  return cells;
}

Table table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects) {
  Table table("Table 2: scenes, rays, database", {{"scene"},
                                                  {"ours"},
                                                  {"polygons printed"},
                                                  {"polygons"},
                                                  {"rays printed"},
                                                  {"rays"},
                                                  {"database printed", "KB"},
                                                  {"database", "KB"},
                                                  {"pages a pixel printed", "", 2},
                                                  {"pages a pixel", "", 2}});
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const PaperScene& paper = paper_scenes[scene];
    const auto& result = results[catalogue.counted[scene]];
    if (!result) {
      continue;
    }
    const core::Database& database = subject_of(catalogue.runs[catalogue.counted[scene]], subjects).database;
    table.add_row({paper.title, paper.scene, paper.polygons, std::uint64_t{database.header().primitive_count}, paper.rays,
                   result->rays, paper.database_kilobytes, std::uint64_t{database.bytes().size() / 1024}, paper.pages_a_pixel,
                   result->pages_a_pixel});
    table.add_note(std::string(paper.title) + ": " + paper.remark + ".");
  }
  note_missing_rows(table, paper_scenes.size());
  return table;
}

Table table_3(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Table 3: seconds on the iPSC/2, and efficiencies", {{"scene"},
                                                                   {"nodes"},
                                                                   {"printed", "s", 0},
                                                                   {"found", "s", 1},
                                                                   {"found over printed", "", 3},
                                                                   {"efficiency printed", "%", 1},
                                                                   {"efficiency", "%", 1},
                                                                   {"difference", "points", 1},
                                                                   {"use"},
                                                                   {"one worker", "s", 0},
                                                                   {"efficiency against it", "%", 1}});
  for (const CellOfTable3& cell : cells_of_table_3(catalogue, results)) {
    table.add_row({cell.title, std::uint64_t{cell.nodes}, cell.printed_seconds, cell.seconds, cell.seconds / cell.printed_seconds,
                   cell.printed_efficiency, cell.efficiency, cell.efficiency - cell.printed_efficiency,
                   cell.is_calibrated ? "calibrated"
                   : cell.is_base     ? "base"
                                      : "predicted",
                   cell_of(cell.one_worker_seconds), cell_of(cell.efficiency_by_worker())});
  }
  const Differences errors = differences_of(catalogue, results);
  table.add_note(
      "Caches hold the share of the database that they held in the article: of 3.2 MB shared memory a node, what its own pages "
      "leave. Another table shows other memories in place of that.");
  table.add_note(
      "Calibrated: two figures of the machine were fitted to these two cells, the price of an operation and that of "
      "looking up a cached page. All others are predictions.");
  table.add_note(
      "One worker: a node renders, the others of the scene's smallest machine lend it their memories, as the article estimated "
      "times on one node.");
  table.add_note("Predicted efficiencies differ by " + fixed(errors.mean(), 2) + " points on average and " +
                 fixed(errors.worst, 2) + " at worst, " + std::to_string(errors.count) + " cells.");
  note_missing_rows(table, printed_cell_count());
  return table;
}

Table losses(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<Column> columns = {{"scene"}, {"nodes"}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 2});
  }
  Table table("Where the nodes' time goes", columns);
  for (const CellOfTable3& cell : cells_of_table_3(catalogue, results)) {
    std::vector<Cell> row = {cell.title, std::uint64_t{cell.nodes}};
    for (const double percent : cell.parts.percent()) {
      row.emplace_back(percent);
    }
    table.add_row(std::move(row));
  }
  table.add_note("The parts of a row add up to 100 %. Dearer look-ups of cached pages are part of computing.");
  note_missing_rows(table, printed_cell_count());
  return table;
}

Table algorithms(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Figures 5 and 7: efficiency of both algorithms", {{"scene"},
                                                                 {"nodes"},
                                                                 {"rays travel", "s", 1},
                                                                 {"pages travel", "s", 1},
                                                                 {"rays travel efficiency", "%", 1},
                                                                 {"pages travel efficiency", "%", 1}});
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      const auto& rays = results[catalogue.rings_by_rays[scene][column]];
      const auto& pages = results[catalogue.rings_by_pages[scene][column]];
      if (first && rays && pages) {
        const std::uint32_t nodes = paper_node_counts[column];
        table.add_row({rings[scene], std::uint64_t{nodes}, rays->seconds(), pages->seconds(),
                       efficiency(first->seconds(), 1, rays->seconds(), nodes),
                       efficiency(first->seconds(), 1, pages->seconds(), nodes)});
      }
    }
  }
  table.add_note("Both against one node, on which nothing travels. The curves of the article are not printed as numbers.");
  table.add_note(
      "On several nodes the pages of rings-4-t1 travel on the machines of Table 3, whose caches have the article's share of the "
      "database; its rays, and all of rings-3-t1, on nodes with memories of 4 MiB.");
  table.add_note(
      "In the article Rings4 by travelling rays did not fit into the memories of 2 and 4 nodes; our smaller database does.");
  note_missing_rows(table, rings.size() * paper_node_counts.size());
  return table;
}

Table ray_ways(const Catalogue& catalogue, const PaperResults& results) {
  const std::uint32_t node_count = paper_node_counts.back();
  Table table("Ways for rays to travel, on " + std::to_string(node_count) + " nodes", {{"scene"},
                                                                                       {"way"},
                                                                                       {"seconds", "s", 0},
                                                                                       {"efficiency", "%", 1},
                                                                                       {"average load", "%", 1},
                                                                                       {"by way of the host", "%", 2},
                                                                                       {"traffic", "bytes"},
                                                                                       {"tests"}});
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    for (std::size_t way = 0; way < ray_way_names.size(); ++way) {
      const auto& result = results[catalogue.rings_by_way[scene][way]];
      if (first && result) {
        table.add_row({rings[scene], ray_way_names[way], result->seconds(),
                       efficiency(first->seconds(), 1, result->seconds(), node_count), 100 * result->average_load,
                       100 * result->overflowed, result->ray_bytes, result->tests});
      }
    }
  }
  table.add_note("All but the one that is named as in the first row of a scene, which is that of Figures 5 and 7.");
  table.add_note(
      "Without backpressure nodes start primary rays whatever waits, as the article's did: what finds no room in the queue goes "
      "by way of the host. A long queue is one of " +
      std::to_string(long_queue_packets) + " packets, which fill the node's 4 MiB; else there are 512 of them at most.");
  note_missing_rows(table, rings.size() * ray_way_names.size());
  return table;
}

std::string item_text(std::uint32_t side) { return side == 0 ? "static" : std::to_string(side) + "x" + std::to_string(side); }

Table work_items(const Catalogue& catalogue, const PaperResults& results) {
  const std::uint32_t node_count = paper_node_counts.back();
  Table table("Work items of Rings4 on " + std::to_string(node_count) + " nodes", {{"item"},
                                                                                   {"asked of"},
                                                                                   {"seconds", "s", 0},
                                                                                   {"computing", "%", 1},
                                                                                   {"data wait", "%", 2},
                                                                                   {"starvation", "%", 2},
                                                                                   {"messages", "%", 2},
                                                                                   {"idle at the end", "%", 2},
                                                                                   {"faults"}});
  const auto add_row = [&](std::uint32_t side, const char* donor, std::size_t run) {
    if (const auto& result = results[run]) {
      table.add_row({item_text(side), donor, result->seconds(), result->percent(TimePart::computing),
                     result->percent(TimePart::data_wait), result->percent(TimePart::starvation),
                     result->percent(TimePart::messages), result->percent(TimePart::idle_at_end), result->faults});
    }
  };
  for (std::size_t size = 0; size < item_sides.size(); ++size) {
    add_row(item_sides[size], item_sides[size] == 0 ? "nobody" : "ring", catalogue.items[size]);
  }
  for (std::size_t size = 1; size < item_sides.size(); ++size) {
    add_row(item_sides[size], "host", catalogue.items_assigned[size]);
  }
  table.add_note(
      "Static: every node renders its own submap, whatever the others have left. By the ring a node asks for items when its "
      "submap "
      "is done; by the host it asks for every item, and has no submap.");
  note_missing_rows(table, 2 * item_sides.size() - 1);
  return table;
}

Table page_sizes(const Catalogue& catalogue, const PaperResults& results) {
  const std::uint32_t node_count = paper_node_counts.back();
  Table table("A shared memory in software and in hardware, Rings4 on " + std::to_string(node_count) + " nodes",
              {{"shared memory in"},
               {"page", "bytes"},
               {"seconds", "s", 0},
               {"data wait", "%", 2},
               {"messages", "%", 2},
               {"faults"},
               {"traffic", "bytes"}});
  const auto add_rows = [&](const char* kind, const auto& runs) {
    for (std::size_t size = 0; size < runs.size(); ++size) {
      if (const auto& result = results[runs[size]]) {
        table.add_row({kind, std::uint64_t{page_sizes_bytes[size]}, result->seconds(), result->percent(TimePart::data_wait),
                       result->percent(TimePart::messages), result->faults, result->page_bytes});
      }
    }
  };
  add_rows("software", catalogue.paged);
  add_rows("hardware", catalogue.paged_by_hardware);
  table.add_note(
      "Hardware: the look-up of a cached page costs no more than that of one at home, and no processor puts a page into its "
      "frame; "
      "messages are the iPSC/2's.");
  table.add_note(
      "Smaller pages, such as the lines of 64 to 128 bytes of machines that did so (KSR-1, Exemplar, SCI), cannot be had: no "
      "record "
      "crosses a page, and one takes up to " +
      std::to_string(core::record_bytes_max) + " bytes.");
  note_missing_rows(table, 2 * page_sizes_bytes.size());
  return table;
}

Table caches(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Figures 8 to 10: caches on " + std::to_string(cache_node_count) + " nodes", {{"scene"},
                                                                                            {"cache in the article", "pages"},
                                                                                            {"cache", "pages"},
                                                                                            {"of the database", "%", 3},
                                                                                            {"efficiency", "%", 1},
                                                                                            {"faults"},
                                                                                            {"miss ratio", "%", 3},
                                                                                            {"page traffic a node", "bytes/s", 0},
                                                                                            {"page wait", "%", 1},
                                                                                            {"service_busy", "%", 1}});
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    const auto& base = results[catalogue.cache_base[scene]];
    for (std::size_t size = 0; size < cache_size_count; ++size) {
      if (const auto& result = results[catalogue.cached[scene][size]]; base && result) {
        table.add_row({cache_scenes[scene].row().scene, std::uint64_t{cache_scenes[scene].pages[size]},
                       std::uint64_t{result->cache_pages}, 100 * cache_scenes[scene].share(size),
                       efficiency(base->seconds(), 1, result->seconds(), cache_node_count), result->faults,
                       100 * result->miss_ratio(), result->page_rate(cache_node_count), result->percent(TimePart::data_wait),
                       result->percent(TimePart::service_busy)});
      }
    }
  }
  table.add_note("Caches have the article's share of the database in place of its pages, since ours are smaller (Table 2).");
  table.add_note(
      "With one pixel in flight a node asks for a page only when the one before has come, so its traffic grows as long as the "
      "cache shrinks, until it does little else than wait.");
  table.add_note("Pictures of half the resolution a side: small caches miss too often for the whole one.");
  note_missing_rows(table, cache_scenes.size() * cache_size_count);
  return table;
}

}  // namespace dmpc::apps
