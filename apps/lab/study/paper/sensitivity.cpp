#include "apps/lab/study/paper/sensitivity.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/tables.h"
#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

using core::Charge;
using nodes::Machine;
using nodes::MessageCost;

std::uint64_t& price(Machine& machine, Charge charge) { return machine.cost_ps[static_cast<std::size_t>(charge)]; }

/// Charges whose prices affect Table 3's runs.
constexpr std::pair<Charge, const char*> charges[] = {
    {Charge::ray_setup, "ray set-up"},        {Charge::cell_step, "cell step"}, {Charge::bvh_node_read, "BVH node read"},
    {Charge::triangle_test, "triangle test"}, {Charge::shading, "shading"},     {Charge::cached_lookup, "cached look-up"},
    {Charge::page_install, "page install"}};

std::string time_text(std::uint64_t ps) {
  const auto ns = 1e-3 * static_cast<double>(ps);
  return ns < 1000 ? fixed(ns, 1) + " ns" : fixed(1e-3 * ns, 1) + " us";
}

/// Returns "50.0 us and 430.0 us", of short and long messages.
std::string both(std::uint64_t of_short_ps, std::uint64_t of_long_ps) {
  return of_short_ps == of_long_ps ? time_text(of_short_ps) : time_text(of_short_ps) + " and " + time_text(of_long_ps);
}

/// Scales figures by a fifth down and up: the numerator is over 5.
class Scaled {
 public:
  Scaled(const Machine& machine, std::vector<Variation>& variations) : machine_(machine), variations_(variations) {}

  using Scale = std::function<void(Machine&, const std::function<void(std::uint64_t&)>& scale)>;

  void add(const std::string& figure, const std::string& value, const Scale& scale_figures) {
    for (const auto& [change, fifths] : {std::pair("-20 %", 4U), std::pair("+20 %", 6U)}) {
      Variation variation{figure, value, change, machine_};
      scale_figures(variation.machine, [fifths = fifths](std::uint64_t& figure_) { figure_ = figure_ * fifths / 5; });
      variations_.push_back(std::move(variation));
    }
  }
  /// Adds a figure that messages of both classes have.
  void add_of_messages(const std::string& figure, std::uint64_t MessageCost::*member, std::uint64_t ps) {
    add(figure, both(machine_.short_message.*member * ps, machine_.long_message.*member * ps),
        [member](Machine& machine, const auto& scale) {
          scale(machine.short_message.*member);
          scale(machine.long_message.*member);
        });
  }

 private:
  const Machine& machine_;
  std::vector<Variation>& variations_;
};

void add_operations(Scaled& scaled, const Machine& machine) {
  scaled.add("all operations", "", [](Machine& all, const auto& scale) {
    for (std::uint64_t& cost : all.cost_ps) {
      scale(cost);
    }
  });
  for (const auto& [charge, name] : charges) {
    const std::uint64_t ps = machine.cost_ps[static_cast<std::size_t>(charge)];
    if (ps > 0) {
      scaled.add(name, time_text(ps), [charge = charge](Machine& one, const auto& scale) { scale(price(one, charge)); });
    }
  }
}

void add_messages(Scaled& scaled, const Machine& machine) {
  constexpr std::uint64_t ns = 1000;
  scaled.add("short message latency", time_text(machine.short_message.latency_ns * ns),
             [](Machine& one, const auto& scale) { scale(one.short_message.latency_ns); });
  scaled.add("long message latency", time_text(machine.long_message.latency_ns * ns),
             [](Machine& one, const auto& scale) { scale(one.long_message.latency_ns); });
  scaled.add_of_messages("a byte", &MessageCost::byte_ps, 1);
  scaled.add_of_messages("send overhead", &MessageCost::send_ns, ns);
  scaled.add_of_messages("receive overhead", &MessageCost::receive_ns, ns);
  scaled.add("a hop", time_text(machine.hop_ns * ns), [](Machine& one, const auto& scale) { scale(one.hop_ns); });
  scaled.add("interrupt service", time_text(machine.service_ns * ns),
             [](Machine& one, const auto& scale) { scale(one.service_ns); });
}

Variation dearer_home(Machine machine) {
  const std::string value = time_text(price(machine, Charge::home_lookup));
  price(machine, Charge::home_lookup) += price(machine, Charge::cached_lookup) / 5;
  return {"home look-up", value, "a fifth of a cached one's", std::move(machine)};
}

Variation without_contention(Machine machine) {
  machine.has_contention = false;
  return {"contention for links", "", "off", std::move(machine)};
}

/// Efficiencies of the watched cells, and their differences from the printed ones.
struct Watched {
  std::array<double, watched_cells.size()> efficiency{};
  Differences differences;
};

std::optional<Watched> watched(const PaperResults& results, const std::array<RunsByNodeCount, paper_scenes.size()>& timed) {
  Watched watched;
  for (std::size_t i = 0; i < watched_cells.size(); ++i) {
    const auto [scene, column] = watched_cells[i];
    const PaperScene& paper = paper_scenes[scene];
    const auto found = found_efficiency(timed[scene], results, paper.base(), column);
    if (!found) {
      return std::nullopt;
    }
    watched.efficiency[i] = *found;
    watched.differences.add(*found - printed_efficiency(paper, column));
  }
  return watched;
}

std::string name_of(const PaperPlace& cell) {
  return std::string(paper_scenes[cell.scene].title) + " " + std::to_string(paper_node_counts[cell.column]);
}

std::vector<Column> sensitivity_columns() {
  std::vector<Column> columns = {{"figure"}, {"in the preset"}, {"change"}};
  for (const PaperPlace& cell : watched_cells) {
    columns.push_back({name_of(cell), "points", 2});
  }
  columns.push_back({"mean error", "points", 2});
  columns.push_back({"worst error", "points", 2});
  return columns;
}

std::vector<Cell> row_of(const Variation& variation, const Watched& before, const Watched& after) {
  std::vector<Cell> row = {variation.figure, variation.value.empty() ? Cell() : Cell(variation.value), variation.change};
  for (std::size_t cell = 0; cell < watched_cells.size(); ++cell) {
    row.emplace_back(after.efficiency[cell] - before.efficiency[cell]);
  }
  row.emplace_back(after.differences.mean() - before.differences.mean());
  row.emplace_back(after.differences.worst - before.differences.worst);
  return row;
}

std::string note_of(const Watched& before) {
  std::string text = "By the preset:";
  for (std::size_t cell = 0; cell < watched_cells.size(); ++cell) {
    text += " " + name_of(watched_cells[cell]) + " " + fixed(before.efficiency[cell], 2) + " %,";
  }
  return text + " mean error " + fixed(before.differences.mean(), 2) + " points, worst " + fixed(before.differences.worst, 2) +
         ". The rows are changes of these, not calibrated anew.";
}

}  // namespace

std::vector<Variation> variations_of(const Machine& machine) {
  std::vector<Variation> variations;
  Scaled scaled(machine, variations);
  add_operations(scaled, machine);
  variations.push_back(dearer_home(machine));
  add_messages(scaled, machine);
  variations.push_back(without_contention(machine));
  return variations;
}

std::vector<VariedRuns> add_variations(Catalogue& catalogue) {
  std::vector<VariedRuns> varied;
  const Machine machine = catalogue.runs[catalogue.grid.timed[0][0]].machine;
  for (const Variation& variation : variations_of(machine)) {
    VariedRuns& runs = varied.emplace_back(VariedRuns{variation});
    const auto add = [&](std::size_t scene, std::size_t column) {
      PaperRun run = catalogue.runs[catalogue.grid.timed[scene][column]];
      run.machine = variation.machine;
      runs.timed[scene][column] = catalogue.add(run);
    };
    std::size_t last_scene = paper_scenes.size();
    for (const auto [scene, column] : watched_cells) {
      if (scene != last_scene) {
        add(scene, paper_scenes[scene].base());
      }
      add(scene, column);
      last_scene = scene;
    }
  }
  return varied;
}

Table sensitivity(const Catalogue& catalogue, const PaperResults& results, const std::vector<VariedRuns>& varied) {
  Table table("Sensitivity: what a figure of ipsc2 does to efficiencies of Table 3 on dmpc's grid", sensitivity_columns());
  const std::optional<Watched> before = watched(results, catalogue.grid.timed);
  if (before) {
    for (const VariedRuns& runs : varied) {
      if (const auto after = watched(results, runs.timed)) {
        table.add_row(row_of(runs.variation, *before, *after));
      }
    }
    table.add_note(note_of(*before));
  }
  table.add_note(
      "A home look-up is free in the preset, and a fifth of nothing is nothing: so its row has a fifth of another price.");
  table.add_note("Spheres, cones and packed rays have prices, too, but Table 3's runs have none of them.");
  note_missing_rows(table, varied.size());
  return table;
}

}  // namespace dmpc::apps
