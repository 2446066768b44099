
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/lab/study/paper/tables.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

std::optional<VoxelCell> voxel_cell_of(const Catalogue& catalogue, const PaperResults& results, const PaperPlace& place) {
  const PaperScene& paper = paper_scenes[place.scene];
  const RunsByNodeCount& runs = catalogue.voxels.timed[place.scene];
  if (place.column < paper.base() || !results[runs[place.column]]) {
    return std::nullopt;
  }
  const PaperResult& result = *results[runs[place.column]];
  const auto& alone = results[catalogue.voxels.one_worker[place.scene]];
  const double nodes = paper_node_counts[place.column], seconds = paper.seconds[place.column];
  const auto rays = static_cast<double>(std::max(std::uint64_t{1}, result.rays));
  return VoxelCell{.place = place,
                   .printed_seconds = seconds,
                   .seconds = result.seconds(),
                   .ray = {ray_time_of(result), 1000 * seconds * nodes / static_cast<double>(paper.rays)},
                   .milliseconds = 1000 * result.seconds() * nodes / rays,
                   .printed_efficiency = printed_efficiency(paper, place.column),
                   .efficiency = found_efficiency(runs, results, paper.base(), place.column),
                   .one_worker_seconds = alone ? std::optional(alone->seconds()) : std::nullopt};
}

/// "mean 4.1 %, at worst 9.0 %, 20 cells".
std::string text_of(const Differences& differences) {
  return fixed(100 * differences.mean(), 1) + " % in the mean and " + fixed(100 * differences.worst, 1) + " % at worst, " +
         counted(differences.count, "cell");
}

void note_errors(Table& table, const std::vector<VoxelCell>& cells) {
  Differences seconds, seconds_of_theirs, efficiencies;
  for (const VoxelCell& cell : cells) {
    if (!cell.is_fitted()) {
      seconds.add(cell.ratio() - 1);
      if (cell.place.scene != small_row) {
        seconds_of_theirs.add(cell.ratio() - 1);
      }
      if (!cell.is_base() && cell.efficiency) {
        efficiencies.add(*cell.efficiency - cell.printed_efficiency);
      }
    }
  }
  table.add_note("Predicted times of a ray lie off by " + text_of(seconds) + "; without Teapot, which is another scene, by " +
                 text_of(seconds_of_theirs) + ".");
  table.add_note("Predicted efficiencies differ by " + fixed(efficiencies.mean(), 2) + " points on average and " +
                 fixed(efficiencies.worst, 2) + " at worst, " + counted(efficiencies.count, "cell") + ".");
}

/// By scene, the mean of found over printed with these prices.
struct Fitness {
  std::array<Differences, paper_scenes.size()> ratios{};  ///< the ratios themselves, not their differences from 1
  Differences errors;
};
Fitness fitness_of(const VoxelPrices& prices, const std::vector<VoxelCell>& cells) {
  Fitness fitness;
  for (const VoxelCell& cell : cells) {
    const double ratio = cell.ray.time.milliseconds(prices) / cell.ray.printed;
    fitness.ratios[cell.place.scene].add(ratio);
    fitness.errors.add(ratio - 1);
  }
  return fitness;
}

/// Returns the prices fitted to the cells on the smallest and the largest machine of these scenes.
std::optional<VoxelPrices> prices_of(const std::vector<VoxelCell>& cells, std::size_t one, std::size_t other) {
  std::vector<PricedCell> chosen;
  for (const VoxelCell& cell : cells) {
    const bool is_end = cell.is_base() || cell.place.column + 1 == paper_node_counts.size();
    if (is_end && (cell.place.scene == one || cell.place.scene == other)) {
      chosen.push_back(cell.ray);
    }
  }
  return fit_prices(chosen);
}

/// A figure of a machine, in microseconds.
struct PricedFigure {
  const char* name;
  core::Charge charge;
};
constexpr std::array<PricedFigure, 5> priced_figures = {
    {{"a step to the next voxel, its entry read", core::Charge::cell_step},
     {"a reference read and its polygon tested", core::Charge::triangle_test},
     {"a ray set up", core::Charge::ray_setup},
     {"a hit shaded", core::Charge::shading},
     {"a look-up of a page that is not at home, beyond one that is", core::Charge::cached_lookup}}};

double price_us(const nodes::Machine& machine, core::Charge charge) {
  return 1e-6 * static_cast<double>(machine.cost_ps[static_cast<std::size_t>(charge)]);
}

void note_ties(Table& table) {
  table.add_note(
      "Four cells of two scenes have two levels and two slopes over nodes. Both slopes are the dearer look-up's, whatever else "
      "a further node costs there; two levels tell two numbers of what a ray does. So steps are tied to tests, and rays to "
      "hits, in the proportions that one core of today has: a step of 7.5 ns, a reference and its polygon as a record read and "
      "a test, 14.7 and 3.7 ns; 55 ns a ray, 167 ns a hit. Each reference that is read has its polygon tested, so no count can "
      "tell them apart.");
  table.add_note("The machine is ipsc2-1994; what pages and messages cost is as on ipsc2.");
}

}  // namespace

bool VoxelCell::is_fitted() const { return std::find(fitted_places.begin(), fitted_places.end(), place) != fitted_places.end(); }

std::vector<VoxelCell> voxel_cells(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<VoxelCell> cells;
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      if (const auto cell = voxel_cell_of(catalogue, results, {scene, column})) {
        cells.push_back(*cell);
      }
    }
  }
  return cells;
}

Table voxel_table_2(const Catalogue& catalogue, const PaperResults& results, const std::vector<PaperSubject>& subjects) {
  Table table("Table 2 on the article's own structure", {{"scene"},
                                                         {"ours"},
                                                         {"database printed", "KB"},
                                                         {"database", "KB"},
                                                         {"database over printed", "", 3},
                                                         {"pages a pixel printed", "", 2},
                                                         {"pages a pixel", "", 2},
                                                         {"pages over printed", "", 3}});
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const PaperScene& paper = paper_scenes[scene];
    const std::size_t number = catalogue.voxels.counted[scene];
    if (!results[number]) {
      continue;
    }
    const std::uint64_t kilobytes = subject_of(catalogue.runs[number], subjects).database.bytes().size() / 1024;
    const double pages = results[number]->pages_a_pixel;
    table.add_row({paper.title, paper.scene, paper.database_kilobytes, kilobytes,
                   static_cast<double>(kilobytes) / static_cast<double>(paper.database_kilobytes), paper.pages_a_pixel, pages,
                   pages / paper.pages_a_pixel});
  }
  note_missing_rows(table, paper_scenes.size());
  table.add_note(
      "A plain grid of voxels, each with a list of polygons: 14 voxels a polygon, at most 64x64x64; 4 bytes a voxel and a "
      "reference, 129 a polygon; z fastest. These six were chosen so that this table comes out, so it is no prediction, but for "
      "Teapot, which is another scene. Nothing was fitted to figures, misses or balance.");
  return table;
}

Table voxel_table_3(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Table 3 on the article's own structure, with its bytes", {{"scene"},
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
  const std::vector<VoxelCell> cells = voxel_cells(catalogue, results);
  for (const VoxelCell& cell : cells) {
    const auto difference = cell.efficiency ? std::optional(*cell.efficiency - cell.printed_efficiency) : std::nullopt;
    const auto by_worker = cell.one_worker_seconds
                               ? std::optional(efficiency(*cell.one_worker_seconds, 1, cell.seconds, cell.nodes()))
                               : std::nullopt;
    table.add_row({cell.scene().title, std::uint64_t{cell.nodes()}, cell.printed_seconds, cell.seconds,
                   cell.seconds / cell.printed_seconds, cell.ratio(), cell.printed_efficiency, cell_of(cell.efficiency),
                   cell_of(difference), cell_of(cell.one_worker_seconds), cell_of(by_worker),
                   cell.is_fitted() ? "fitted"
                   : cell.is_base() ? "base"
                                    : "predicted"});
  }
  table.add_note(
      "Memories of 4 MB, of which 3.2 serve the shared memory, in pages of 1 KB: the article's bytes. A ray's time is the nodes' "
      "over the rays, since ours are not quite as many as the article's (Table 2). Of cells that are fitted neither seconds nor "
      "efficiencies are predictions; of a base the seconds are.");
  note_errors(table, cells);
  note_missing_rows(table, printed_cell_count());
  return table;
}

Table voxel_prices(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Prices on the article's own structure: Mountain on 1 and 64 nodes, Rings4 on 2 and 64",
              {{"figure"}, {"on the machine", "us", 1}, {"fitted", "us", 1}, {"change", "%", 2}});
  std::vector<PricedCell> chosen;
  for (const PaperPlace& place : fitted_places) {
    if (const auto cell = voxel_cell_of(catalogue, results, place)) {
      chosen.push_back(cell->ray);
    }
  }
  const auto prices = chosen.size() == fitted_places.size() ? fit_prices(chosen) : std::nullopt;
  if (prices) {
    const nodes::Machine before = voxel_machine(fitted_voxel_prices), after = voxel_machine(*prices);
    for (const auto& [name, charge] : priced_figures) {
      const double was = price_us(before, charge), is = price_us(after, charge);
      table.add_row({name, was, is, 100 * (is / was - 1)});
    }
  }
  note_missing_rows(table, priced_figures.size());
  note_ties(table);
  table.add_note("The printed times are those of 512x512 pixels: with any other --resolution the fitted prices mean nothing.");
  return table;
}

Table voxel_pairs(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<Column> columns = {{"fitted to"},    {"step", "us", 0}, {"test", "us", 0},
                                 {"ray", "ms", 2}, {"hit", "ms", 2},  {"look-up", "us", 1}};
  for (const PaperScene& scene : paper_scenes) {
    columns.push_back({scene.title, "", 2});
  }
  columns.insert(columns.end(), {{"mean error", "%", 1}, {"worst error", "%", 1}});
  Table table("Times of a ray over printed ones, by prices fitted to any two scenes", std::move(columns));
  const std::vector<VoxelCell> cells = voxel_cells(catalogue, results);
  constexpr std::size_t pair_count = paper_scenes.size() * (paper_scenes.size() - 1) / 2;
  for (std::size_t one = 0; one < paper_scenes.size() && cells.size() == printed_cell_count(); ++one) {
    for (std::size_t other = one + 1; other < paper_scenes.size(); ++other) {
      const auto prices = prices_of(cells, one, other);
      core::expect(prices.has_value(), "cells have prices that fit them best");
      const nodes::Machine machine = voxel_machine(*prices);
      const Fitness fitness = fitness_of(*prices, cells);
      std::vector<Cell> row = {std::string(paper_scenes[one].title) + ", " + paper_scenes[other].title,
                               price_us(machine, core::Charge::cell_step),
                               price_us(machine, core::Charge::triangle_test),
                               1e-3 * price_us(machine, core::Charge::ray_setup),
                               1e-3 * price_us(machine, core::Charge::shading),
                               price_us(machine, core::Charge::cached_lookup)};
      for (const Differences& ratios : fitness.ratios) {
        row.emplace_back(ratios.mean());
      }
      row.insert(row.end(), {100 * fitness.errors.mean(), 100 * fitness.errors.worst});
      table.add_row(std::move(row));
    }
  }
  note_missing_rows(table, pair_count);
  table.add_note(
      "Fits, not predictions, from runs on the machine of Mountain and Rings4: the time of a ray is linear in its prices, nodes "
      "idle in proportion to what they compute, and messages and waits for pages are left as they were. Smallest and largest "
      "machine of each scene, of Tetra10 its one cell. Of each scene the mean over its cells, the errors over all.");
  return table;
}

}  // namespace dmpc::apps
