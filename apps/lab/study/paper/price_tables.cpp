// The prices of the machine ipsc2-1994 beside fits of them to cells of Table 3.
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

/// By scene, the mean of found over printed with these prices.
struct Fitness {
  std::array<Differences, paper_scenes.size()> ratios{};  ///< the ratios themselves, not their differences from 1
  Differences errors;
};
Fitness fitness_of(const VoxelPrices& prices, const std::vector<TimedCell>& cells) {
  Fitness fitness;
  for (const TimedCell& cell : cells) {
    const double ratio = cell.ray.time.milliseconds(prices) / cell.ray.printed;
    fitness.ratios[cell.place.scene].add(ratio);
    fitness.errors.add(ratio - 1);
  }
  return fitness;
}

/// Returns the prices fitted to the cells on the smallest and the largest machine of these scenes.
std::optional<VoxelPrices> prices_of(const std::vector<TimedCell>& cells, std::size_t one, std::size_t other) {
  std::vector<PricedCell> chosen;
  for (const TimedCell& cell : cells) {
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

Table voxel_prices(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Prices: Mountain on 1 and 64 nodes, Rings4 on 2 and 64",
              {{"figure"}, {"on the machine", "us", 1}, {"fitted", "us", 1}, {"change", "%", 2}});
  std::vector<PricedCell> chosen;
  for (const TimedCell& cell : cells_of(catalogue.article, results)) {
    if (cell.is_fitted) {
      chosen.push_back(cell.ray);
    }
  }
  const auto fit = chosen.size() == fitted_places.size() ? fit_prices(chosen) : std::nullopt;
  if (fit) {
    const nodes::Machine before = voxel_machine(fitted_voxel_prices), after = voxel_machine(*fit);
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
  const std::vector<TimedCell> cells = cells_of(catalogue.article, results);
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
      "Fits, not predictions, from runs on ipsc2-1994: the time of a ray is linear in its prices, nodes idle in "
      "proportion to what they compute, and messages and waits for pages are left as they were. Smallest and largest "
      "machine of each scene, of Tetra10 its one cell. Of each scene the mean over its cells, the errors over all.");
  return table;
}

}  // namespace dmpc::apps
