#include "apps/lab/study/paper/tables.h"

#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/filled_columns.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

std::optional<TimedCell> timed_cell_of(const TimedRuns& runs, const PaperResults& results, const PaperPlace& place) {
  const PaperScene& paper = paper_scenes[place.scene];
  const RunsByNodeCount& timed = runs.timed[place.scene];
  if (place.column < paper.base() || !results[timed[place.column]]) {
    return std::nullopt;
  }
  const PaperResult& result = *results[timed[place.column]];
  const auto& alone = results[runs.one_worker[place.scene]];
  const double nodes = paper_node_counts[place.column], seconds = paper.seconds[place.column];
  const auto rays = static_cast<double>(std::max(std::uint64_t{1}, result.rays));
  return TimedCell{.place = place,
                   .is_fitted = std::find(runs.fitted.begin(), runs.fitted.end(), place) != runs.fitted.end(),
                   .printed_seconds = seconds,
                   .seconds = result.seconds(),
                   .ray = {ray_time_of(result), 1000 * seconds * nodes / static_cast<double>(paper.rays)},
                   .milliseconds = 1000 * result.seconds() * nodes / rays,
                   .printed_efficiency = printed_efficiency(paper, place.column),
                   .efficiency = found_efficiency(timed, results, paper.base(), place.column),
                   .one_worker_seconds = alone ? std::optional(alone->seconds()) : std::nullopt,
                   .parts = result.parts};
}

Table table_3_of(const std::string& title, const std::vector<TimedCell>& cells) {
  Table table(title, {{"scene"},
                      {"nodes"},
                      {"printed", "s", 0},
                      {"found", "s", 1},
                      {"found over printed", "", 3},
                      {"the same a ray", "", 3},
                      {"efficiency printed", "%", 1},
                      {"efficiency", "%", 1},
                      {"difference", "points", 1},
                      {"one worker", "s", 0},
                      {"efficiency against it", "%", 1},
                      {"use"}});
  for (const TimedCell& cell : cells) {
    const auto difference = cell.efficiency ? std::optional(*cell.efficiency - cell.printed_efficiency) : std::nullopt;
    table.add_row({cell.scene().title, std::uint64_t{cell.nodes()}, cell.printed_seconds, cell.seconds,
                   cell.seconds / cell.printed_seconds, cell.ratio(), cell.printed_efficiency, cell_of(cell.efficiency),
                   cell_of(difference), cell_of(cell.one_worker_seconds), cell_of(cell.efficiency_by_worker()),
                   cell.is_fitted   ? "fitted"
                   : cell.is_base() ? "base"
                                    : "predicted"});
  }
  table.add_note(
      "Efficiencies: against the scene's smallest printed machine. One worker: a node renders, the others of that machine lend "
      "it "
      "their memories, as the article estimated times on one node.");
  const Errors errors = errors_of(cells);
  table.add_note("Predicted times of a ray lie off by " + text_of(errors.times) +
                 "; without Teapot, which is another scene, by " + text_of(errors.times_without_teapot) +
                 ". Predicted efficiencies differ by " + fixed(errors.efficiencies.mean(), 2) + " points on average and " +
                 fixed(errors.efficiencies.worst, 2) + " at worst, " + counted(errors.efficiencies.count, "cell") + ".");
  note_missing_rows(table, printed_cell_count());
  return table;
}

}  // namespace

std::optional<double> found_efficiency(const RunsByNodeCount& runs, const PaperResults& results, std::size_t base,
                                       std::size_t column) {
  const auto &first = results[runs[base]], &result = results[runs[column]];
  if (!first || !result) {
    return std::nullopt;
  }
  return efficiency(first->seconds(), paper_node_counts[base], result->seconds(), paper_node_counts[column]);
}

std::size_t printed_cell_count() {
  return core::sum_over<std::size_t>(paper_scenes,
                                     [&](const PaperScene& scene) { return paper_node_counts.size() - scene.base(); });
}

void note_missing_rows(Table& table, std::size_t expected) {
  core::expect(table.rows().size() <= expected, "a table has no more rows than it can have");
  if (const std::size_t missing = expected - table.rows().size(); missing > 0) {
    table.add_note("Unfinished: " + std::to_string(missing) + " of " + std::to_string(expected) + " rows are missing.");
  }
}

std::vector<TimedCell> cells_of(const TimedRuns& runs, const PaperResults& results) {
  std::vector<TimedCell> cells;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      if (const auto cell = timed_cell_of(runs, results, {scene, column})) {
        cells.push_back(*cell);
      }
    }
  }
  return cells;
}

Errors errors_of(const std::vector<TimedCell>& cells) {
  Errors errors;
  for (const TimedCell& cell : cells) {
    if (!cell.is_fitted) {
      errors.times.add(cell.ratio() - 1);
      if (cell.place.scene != small_row) {
        errors.times_without_teapot.add(cell.ratio() - 1);
      }
    }
    if (cell.is_predicted()) {
      errors.efficiencies.add(*cell.efficiency - cell.printed_efficiency);
    }
  }
  return errors;
}

std::string text_of(const Differences& times) {
  return fixed(100 * times.mean(), 1) + " % in the mean and " + fixed(100 * times.worst, 1) + " % at worst, " +
         counted(times.count, "cell");
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
                                                  {"database over printed", "", 3},
                                                  {"pages a pixel printed", "", 2},
                                                  {"pages a pixel", "", 2},
                                                  {"pages over printed", "", 3}});
  std::string remarks;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const PaperScene& paper = paper_scenes[scene];
    const std::size_t number = catalogue.counted[scene];
    if (!results[number]) {
      continue;
    }
    const core::Database& database = subject_of(catalogue.runs[number], subjects).database;
    const std::uint64_t kilobytes = database.bytes().size() / 1024;
    const double pages = results[number]->pages_a_pixel;
    table.add_row({paper.title, paper.scene, paper.polygons, std::uint64_t{database.header().primitive_count}, paper.rays,
                   results[number]->rays, paper.database_kilobytes, kilobytes,
                   static_cast<double>(kilobytes) / static_cast<double>(paper.database_kilobytes), paper.pages_a_pixel, pages,
                   pages / paper.pages_a_pixel});
    remarks += (remarks.empty() ? "Rays and scenes: " : "; ") + std::string(paper.title) + ", " + paper.remark;
  }
  if (!remarks.empty()) {
    table.add_note(remarks + ".");
  }
  note_missing_rows(table, paper_scenes.size());
  table.add_note(
      "The structure is a plain grid of voxels, each with a list of polygons: 14 voxels a polygon, at most 64x64x64; 4 bytes a "
      "voxel and a reference, 129 a polygon; z fastest. These six were chosen so that this table comes out, so it is no "
      "prediction, but for Teapot, which is another scene. Nothing was fitted to figures, misses or balance.");
  return table;
}

Table table_3(const Catalogue& catalogue, const PaperResults& results) {
  Table table = table_3_of("Table 3: seconds on the iPSC/2, and efficiencies", cells_of(catalogue.article, results));
  table.add_note(
      "Memories of 4 MB, of which 3.2 serve the shared memory, in pages of 1 KB: the article's bytes. A ray's time is the nodes' "
      "over the rays, since ours are not quite as many as the article's (Table 2). Of cells that are fitted neither seconds nor "
      "efficiencies are predictions; of a base the seconds are.");
  return table;
}

Table grid_table_3(const Catalogue& catalogue, const PaperResults& results) {
  Table table = table_3_of("Table 3 on dmpc's grid, with the prices of the preset ipsc2", cells_of(catalogue.grid, results));
  table.add_note(
      "Its databases are smaller than the article's, so caches hold the share of the database that they held there: of 3.2 MB "
      "shared memory a node, what its own pages leave. Two figures of the machine are fitted to two cells.");
  return table;
}

Table losses(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<Column> columns = {{"scene"}, {"nodes"}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 2});
  }
  Table table("Where the nodes' time goes", columns);
  for (const TimedCell& cell : cells_of(catalogue.article, results)) {
    std::vector<Cell> row = {cell.scene().title, std::uint64_t{cell.nodes()}};
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
  table.add_note(
      "Efficiencies: both against one node that has the whole scene at home. Memories of 4 MB. The curves of the article are not "
      "printed as numbers.");
  table.add_note(
      "In the article Rings4 by travelling rays did not fit into the memories of 2 and 4 nodes; here a node's part of it does.");
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
      const auto& result = results[catalogue.by_ray_way[scene][way]];
      if (first && result) {
        table.add_row({rings[scene], ray_way_names[way], result->seconds(),
                       efficiency(first->seconds(), 1, result->seconds(), node_count), 100 * result->average_load,
                       100 * result->overflowed, result->ray_bytes, result->tests});
      }
    }
  }
  table.add_note(
      "As in 1994: regions from a subsampled picture, cut in alternating directions, and no backpressure: nodes start primary "
      "rays "
      "whatever waits, and what finds no room in the queue goes by way of the host. The other rows differ in what they are named "
      "for. A long queue is one of " +
      std::to_string(long_queue_packets) +
      " packets of 8 rays, which fill the node's 4 MiB; else there are 512 of them at most. Efficiencies as in Figures 5 and 7.");
  note_missing_rows(table, rings.size() * ray_way_names.size());
  return table;
}

Table region_loads(const Catalogue& catalogue, const PaperResults& results) {
  Table table("The load of Rings3's regions", {{"regions"},
                                               {"nodes"},
                                               {"average load", "%", 1},
                                               {"seconds", "s", 0},
                                               {"tests over one node's", "", 3},
                                               {"by way of the host", "%", 2}});
  const auto& one = results[catalogue.rings_by_rays[0][0]];
  const auto add_row = [&](const char* regions, std::size_t i, std::size_t run) {
    if (const auto& result = results[run]; one && result) {
      table.add_row({regions, std::uint64_t{loaded_node_counts[i]}, 100 * result->average_load, result->seconds(),
                     one->tests == 0 ? 1 : static_cast<double>(result->tests) / static_cast<double>(one->tests),
                     100 * result->overflowed});
    }
  };
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    add_row("subsampled", i, catalogue.rings_by_rays[0][loaded_column + i]);
  }
  for (std::size_t i = 0; i < loaded_node_counts.size(); ++i) {
    add_row("of equal size", i, catalogue.equal_sizes[i]);
  }
  note_missing_rows(table, 2 * loaded_node_counts.size());
  table.add_note(
      "Mean over maximum of the nodes' work; the article has about 82.5 % and less than 20 %, and does not say on how many "
      "nodes. Regions whose border runs through a voxel test what lies on both sides again, and spare what lies on the other: in "
      "the loads both are counted.");
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
  add_row(1, "host", catalogue.assigned_pixels);
  add_row(item_sides[article_item], "host", catalogue.assigned_items);
  table.add_note(
      "Static: every node renders its own submap, whatever others have left. By the ring a node asks for items when its submap "
      "is done; by the host it asks for every item, and has no submap.");
  note_missing_rows(table, item_sides.size() + 2);
  return table;
}

Table caches(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Figures 8 to 10: caches on " + std::to_string(cache_node_count) + " nodes",
              {{"scene"},
               {"cache", "pages"},
               {"of the database", "%", 3},
               {"efficiency", "%", 1},
               {"faults"},
               {"miss ratio", "%", 3},
               {"pages received", "bytes/s", 0},
               {"traffic both ways", "% of 0.9 MB/s", 1},
               {"printed", "% of 0.9 MB/s", 0},
               {"page wait", "%", 1},
               {"service_busy", "%", 1}});
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    const auto& base = results[catalogue.cache_base[scene]];
    for (std::size_t size = 0; size < cache_size_count; ++size) {
      if (const auto& result = results[catalogue.cached[scene][size]]; base && result) {
        const bool is_printed = cache_scenes[scene].paper_row == rings_row && cache_scenes[scene].pages[size] == peak_pages;
        table.add_row({cache_scenes[scene].row().title, std::uint64_t{cache_scenes[scene].pages[size]},
                       100 * cache_scenes[scene].share(size), efficiency(base->seconds(), 1, result->seconds(), cache_node_count),
                       result->faults, 100 * result->miss_ratio(), result->page_rate(cache_node_count),
                       100 * network_share(*result, cache_node_count), is_printed ? Cell(100 * peak_share) : Cell(),
                       result->percent(TimePart::data_wait), result->percent(TimePart::service_busy)});
      }
    }
  }
  note_missing_rows(table, cache_scenes.size() * cache_size_count);
  const std::size_t last = cache_column;
  const auto &one = results[catalogue.rings_by_pages[1][0]], &many = results[catalogue.article.timed[rings_row][last]];
  const auto of_table_3 = found_efficiency(catalogue.article.timed[rings_row], results, paper_scenes[rings_row].base(), last);
  if (one && many && of_table_3) {
    table.add_note(
        "Efficiencies: against one node that has all pages at home, as in Figures 5 and 7. Those of Table 3 are "
        "against the smallest printed machine, whose pages lie on other nodes, too: Rings4 on 32 nodes with all of the "
        "4 MB has " +
        fixed(*of_table_3, 1) + " % there, and " + fixed(efficiency(one->seconds(), 1, many->seconds(), cache_node_count), 1) +
        " % here. The article does not say which base its figures have.");
  }
  table.add_note(
      "Both ways: the pages that a node receives and sends, over the 0.9 MB/s that messages of 1 KB allow. The article prints 70 "
      "% "
      "of that at the peak, with 204 pages. With one pixel in flight a node asks for a page only when the one before has come, "
      "so "
      "its traffic grows as long as the cache shrinks, until it does little else than wait.");
  table.add_note("Pictures of half the resolution a side: small caches miss so often that a whole one takes minutes.");
  return table;
}

}  // namespace dmpc::apps
