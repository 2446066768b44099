#include "apps/lab/study/paper/calibration.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "apps/lab/study/paper/tables.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

constexpr auto lookup_number = static_cast<std::size_t>(core::Charge::cached_lookup);
constexpr auto step_number = static_cast<std::size_t>(core::Charge::cell_step);

std::uint64_t times(std::uint64_t price, double factor) {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(price) * factor));
}

void add_figure(Table& table, const std::string& figure, const nodes::Machine& preset, const nodes::Machine& fit,
                std::size_t charge) {
  const auto before = static_cast<double>(preset.cost_ps[charge]), after = static_cast<double>(fit.cost_ps[charge]);
  table.add_row({figure, 1e-3 * before, 1e-3 * after, 100 * (after / before - 1)});
}

void add_fit(Table& table, const nodes::Machine& preset, const FitTimes& found) {
  const auto fit =
      fit_of(found, {static_cast<double>(calibration_scene.seconds[0]), static_cast<double>(calibration_scene.seconds[1])});
  if (!fit) {
    table.add_note("No price of a cached look-up gives the printed time here.");
    return;
  }
  const nodes::Machine machine = fitted(preset, *fit);
  add_figure(table, "a cell step, and all other operations in proportion", preset, machine, step_number);
  add_figure(table, "a look-up of a cached page", preset, machine, lookup_number);
}

}  // namespace

std::optional<Fit> fit_of(const FitTimes& found, const std::array<double, calibrated_places.size()>& printed) {
  if (found.two_with_dearer_lookups <= found.two) {
    return std::nullopt;
  }
  const double operations = printed[0] / found.one;
  const double change = (printed[1] / operations - found.two) / (found.two_with_dearer_lookups - found.two);
  return change < -1 ? std::nullopt : std::optional(Fit{.operations = operations, .cached_lookup = 1 + change});
}

nodes::Machine fitted(nodes::Machine machine, const Fit& fit) {
  for (std::uint64_t& price : machine.cost_ps) {
    price = times(price, fit.operations);
  }
  machine.cost_ps[lookup_number] = times(machine.cost_ps[lookup_number], fit.cached_lookup);
  return machine;
}

Table calibration(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Calibration of ipsc2 on dmpc's grid: Mountain on one node and on two",
              {{"figure"}, {"in the preset", "ns", 1}, {"fitted", "ns", 1}, {"change", "%", 2}});
  const RunsByNodeCount& timed = catalogue.grid.timed[calibrated_places[0].scene];
  const auto &found = results[timed[0]], &two = results[timed[1]], &dearer = results[catalogue.dearer_cache];
  if (found && two && dearer) {
    add_fit(table, catalogue.runs[timed[0]].machine,
            {.one = found->seconds(), .two = two->seconds(), .two_with_dearer_lookups = dearer->seconds()});
  } else {
    note_missing_rows(table, 2);
  }
  table.add_note("The printed times are those of 512x512 pixels: with any other --resolution the fitted figures mean nothing.");
  return table;
}

}  // namespace dmpc::apps
