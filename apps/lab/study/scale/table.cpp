#include "apps/lab/study/scale/table.h"

#include <algorithm>
#include <span>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/table/filled_columns.h"
#include "apps/lab/study/scale/figures.h"

namespace dmpc::apps {
namespace {

/// Number of the largest rows used for the growth, where small constant costs no longer matter.
constexpr std::size_t last_count = 3;
constexpr int exponent_digits = 2;

enum At : std::size_t { part_at, family_at, scene_at, method_at, nodes_at, primitives_at, figures_at };

std::vector<Column> scale_columns() {
  std::vector<Column> columns = {{"part"}, {"family"}, {"scene"}, {"method"}, {"nodes"}, {"primitives"}};
  columns.insert(columns.end(), scale_figure_columns().begin(), scale_figure_columns().end());
  columns.push_back({"render over first", "", 2});
  return columns;
}

/// Finished runs of one method whose scene, or number of nodes, grows.
using Group = std::vector<const ScaleResult*>;

bool belongs(const ScaleRun& one, const ScaleRun& other) {
  return one.part == other.part && one.method == other.method && one.scene.family == other.scene.family;
}

/// Returns groups in the order of their first runs.
std::vector<Group> groups_of(const std::vector<ScaleResult>& results) {
  std::vector<Group> groups;
  for (const ScaleResult& result : results) {
    if (!result.figures) {
      continue;
    }
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const Group& candidate) { return belongs(candidate.front()->run, result.run); });
    (group == groups.end() ? groups.emplace_back() : *group).push_back(&result);
  }
  return groups;
}

double growing(const ScaleResult& result) {
  return result.run.part == ScalePart::sizes ? static_cast<double>(result.figures->primitives) : result.run.node_count;
}

/// "tetra-5 to tetra-12", "tetra-9 on 1 to 256 nodes".
std::string range_of(std::span<const ScaleResult* const> rows) {
  const ScaleRun &first = rows.front()->run, &last = rows.back()->run;
  if (first.part == ScalePart::sizes) {
    return first.scene.text() + " to " + last.scene.text();
  }
  return first.scene.text() + " on " + std::to_string(first.node_count) + " to " + counted(last.node_count, "node");
}

/// Adds the growth of each figure, as a row and in words. "(2 of 4 rows)": only this many rows have a value above 0.
void add_growth(std::span<const ScaleResult* const> rows, const ScaleSettings& settings, Table& table) {
  const ScaleRun& run = rows.front()->run;
  std::vector<Cell> row(table.columns().size());
  row[part_at] = std::string(run.part == ScalePart::sizes ? "growth by size" : "growth by nodes");
  row[family_at] = run.scene.family;
  row[scene_at] = range_of(rows);
  row[method_at] = settings.name_of(run.method);
  std::string words;
  for (std::size_t i = 0; i < scale_figure_columns().size(); ++i) {
    const std::string& name = scale_figure_columns()[i].name;
    std::vector<std::pair<double, double>> points;
    for (const ScaleResult* const result : rows) {
      if (const auto value = (*result->figures)[name]; value && *value > 0) {
        points.emplace_back(growing(*result), *value);
      }
    }
    if (const auto exponent = growth_exponent(points)) {
      row[figures_at + i] = *exponent;
      words += (words.empty() ? "" : ", ") + name + " " + fixed(*exponent, exponent_digits);
      words +=
          points.size() == rows.size() ? "" : " (" + std::to_string(points.size()) + " of " + counted(rows.size(), "row") + ")";
    }
  }
  table.add_row(std::move(row));
  table.add_note("Growth, " + range_of(rows) + ", " + settings.name_of(run.method) + ": " + words + ".");
}

void add_rows(const std::vector<ScaleResult>& results, const ScaleSettings& settings, Table& table) {
  for (const ScaleResult& result : results) {
    const auto& [run, figures, misfit] = result;
    std::vector<Cell> row = {std::string(name_of(run.part)),
                             run.scene.family,
                             run.scene.text(),
                             settings.name_of(run.method),
                             std::uint64_t{run.node_count},
                             figures ? figures->primitives : core::primitive_count(run.scene)};
    for (const Column& column : scale_figure_columns()) {
      row.push_back(figures ? cell_of((*figures)[column.name]) : Cell());
    }
    const auto first =
        std::find_if(results.begin(), results.end(), [&](const auto& other) { return belongs(other.run, result.run); });
    const double over = first->figures ? (*first->figures)["render"].value_or(0) : 0;
    row.push_back(figures && run.part == ScalePart::nodes && over > 0 ? Cell(*(*figures)["render"] / over) : Cell());
    table.add_row(std::move(row));
    if (!figures) {
      table.add_note(run.scene.text() + ", " + settings.name_of(run.method) + " on " + counted(run.node_count, "node") +
                     ": no figures. " + misfit + ".");
    }
  }
}

void add_explanations(const ScaleSettings& settings, Table& table) {
  table.add_note("Every row is a `dmpc render` of its own with threads for nodes" +
                 (settings.rounds > 1 ? ", the median of " + std::to_string(settings.rounds) : std::string()) +
                 ". svm: pages of 1 KiB; its caches hold so many bytes a node, or a quarter of the database, at least 64 pages.");
  table.add_note(
      "Seconds of wall clock by phase. Prepare: planning, for dataflow balance and deal. Render: with setting the nodes' "
      "memories "
      "aside and dealing out the database; over first: over that with the first number of nodes. Processor: of all threads "
      "together in that phase.");
  table.add_note(
      "MB are 10^6 bytes. Memory: the most anonymous memory that the process ever had, looked at each millisecond, above that of "
      "a dmpc that does nothing; no figure if one of them ended before it was looked at. Local memory: of all nodes, with the "
      "counters of pages a pixel.");
  table.add_note(
      "Moves: how often a ray of dataflow moves on to another node. Pages a pixel: different ones, home pages included.");
  table.add_note(
      "Growth: y grows as x^exponent, x being primitives or nodes; the slope of log y over log x by least squares, over rows in "
      "which y is above 0.");
}

PlotAxis powers_of_10(const std::string& label) { return {.label = label, .scale = PlotScale::powers_of_10}; }

/// Curves of one part and family; `shared` figures do not depend on the method and are drawn once, `figures` for each method.
Plot plot_of(const std::string& name, const std::string& title, const char* unit, const ScaleSettings& settings, ScalePart part,
             const std::string& family, const std::vector<std::string>& shared, const std::vector<std::string>& figures) {
  std::vector<PlotSeries> series;
  const auto add = [&](const std::string& figure, ScaleMethod method, const std::string& more) {
    series.push_back({.title = figure + more,
                      .column = figure,
                      .where = {{"part", name_of(part)}, {"family", family}, {"method", settings.name_of(method)}},
                      .color = series.size()});
  };
  for (const std::string& figure : shared) {
    add(figure, settings.methods.front(), "");
  }
  for (const std::string& figure : figures) {
    for (const ScaleMethod method : settings.methods) {
      add(figure, method, " " + settings.name_of(method));
    }
  }
  const bool by_size = part == ScalePart::sizes;
  return curves("scale_" + (by_size ? family : "nodes") + "_" + name, title + (by_size ? " of " + family : " over nodes"),
                by_size ? "primitives" : "nodes", by_size ? powers_of_10("primitives") : node_axis(), powers_of_10(unit),
                std::move(series));
}

}  // namespace

Table scale_rows(const std::vector<ScaleResult>& results, const ScaleSettings& settings) {
  Table table("", scale_columns());
  add_rows(results, settings, table);
  return table;
}

Table scale_table(const std::vector<ScaleResult>& results, const ScaleSettings& settings) {
  Table table("Study scale: " + std::to_string(settings.resolution.width) + "x" + std::to_string(settings.resolution.height) +
                  " pixels, part sizes on " + counted(settings.node_count, "node"),
              scale_columns());
  add_explanations(settings, table);
  add_rows(results, settings, table);
  for (const Group& group : groups_of(results)) {
    const std::span<const ScaleResult* const> rows(group);
    if (rows.size() > 1) {
      add_growth(rows, settings, table);
    }
    if (rows.size() > last_count) {
      add_growth(rows.last(last_count), settings, table);
    }
  }
  return table;
}

std::string scale_conclusion(const Table& table) {
  const auto exponent = [&](const std::vector<Cell>& row, const char* figure) {
    const auto number = number_in(table, row, figure);
    return number ? fixed(*number, exponent_digits) : std::string("?");
  };
  const auto first = [&](const char* part) {
    return std::find_if(table.rows().begin(), table.rows().end(),
                        [&](const auto& row) { return row[part_at] == Cell(std::string(part)); });
  };
  std::string text;
  if (const auto row = first("growth by size"); row != table.rows().end()) {
    const std::vector<std::string> texts = texts_of(table, *row);
    text += "From " + texts[scene_at] + " by " + texts[method_at] + " building takes primitives to the power of " +
            exponent(*row, "build") + ", rendering of " + exponent(*row, "render") + ", memory of " + exponent(*row, "memory") +
            ". ";
  }
  if (const auto row = first("growth by nodes"); row != table.rows().end()) {
    const std::vector<std::string> texts = texts_of(table, *row);
    text += "For " + texts[scene_at] + " by " + texts[method_at] + " rendering takes nodes to the power of " +
            exponent(*row, "render") + ". ";
  }
  return text.substr(0, text.empty() ? 0 : text.size() - 1);
}

std::vector<Plot> scale_plots(const ScaleSettings& settings) {
  std::vector<Plot> plots;
  for (const ScalePart part : settings.parts) {
    const std::vector<std::string> of_nodes = {settings.scene_of_nodes().family};
    for (const std::string& family : part == ScalePart::sizes ? settings.families : of_nodes) {
      const auto add = [&](const char* name, const char* title, const char* unit, const std::vector<std::string>& shared,
                           const std::vector<std::string>& figures) {
        plots.push_back(plot_of(name, title, unit, settings, part, family, shared, figures));
      };
      add("seconds", "Seconds", "s", {"load", "build"}, {"render"});
      add("memory", "Memory", "MB", {"database"}, {"memory", "local memory"});
      add("traffic", "Traffic", "a ray", {}, {"faults a ray", "moves a ray"});
    }
  }
  return plots;
}

}  // namespace dmpc::apps
