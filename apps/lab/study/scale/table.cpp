#include "apps/lab/study/scale/table.h"

#include <algorithm>
#include <span>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/lab/study/scale/figures.h"

namespace dmpc::apps {
namespace {

/// So many of the largest rows are taken for the growth where small things that do not grow no longer matter.
constexpr std::size_t last_count = 3;
constexpr int exponent_digits = 2;

enum At : std::size_t { part_at, family_at, scene_at, method_at, nodes_at, primitives_at, figures_at };
constexpr std::size_t ratio_at = figures_at + scale_figure_count;

std::vector<Column> scale_columns() {
  std::vector<Column> columns = {{"part"}, {"family"}, {"scene"}, {"method"}, {"nodes"}, {"primitives"}};
  for (const ScaleFigure figure : all_scale_figures()) {
    columns.push_back(column_of(figure));
  }
  columns.push_back({"render over first", "", 2});
  return columns;
}

/// Finished runs of one method whose scene, or number of nodes, grows.
using Group = std::vector<const ScaleResult*>;

bool belongs(const ScaleRun& one, const ScaleRun& other) {
  return one.part == other.part && one.method == other.method && one.scene.family == other.scene.family;
}

/// In the order of their first runs.
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

struct Growth {
  std::optional<double> exponent;
  std::size_t point_count = 0;  ///< that are above 0
};

Growth growth_of(std::span<const ScaleResult* const> rows, ScaleFigure figure) {
  std::vector<std::pair<double, double>> points;
  for (const ScaleResult* row : rows) {
    if (const auto value = (*row->figures)[figure]; value && *value > 0) {
      points.emplace_back(growing(*row), *value);
    }
  }
  return {growth_exponent(points), points.size()};
}

/// "tetra-5 to tetra-12", "tetra-9 on 1 to 256 nodes".
std::string range_of(std::span<const ScaleResult* const> rows) {
  const ScaleRun &first = rows.front()->run, &last = rows.back()->run;
  if (first.part == ScalePart::sizes) {
    return first.scene.text() + " to " + last.scene.text();
  }
  return first.scene.text() + " on " + std::to_string(first.node_count) + " to " + counted(last.node_count, "node");
}

/// The rows of one group's growth.
class GrowthRows {
 public:
  GrowthRows(const ScaleSettings& settings, Table& table) : settings_(settings), table_(table) {}

  void add(const Group& group) {
    const std::span<const ScaleResult* const> rows(group);
    if (rows.size() < 2) {
      return;
    }
    add(rows);
    if (rows.size() > last_count) {
      add(rows.last(last_count));
    }
  }

 private:
  void add(std::span<const ScaleResult* const> rows) {
    const ScaleRun& run = rows.front()->run;
    std::vector<Cell> row(table_.columns().size());
    row[part_at] = std::string(run.part == ScalePart::sizes ? "growth by size" : "growth by nodes");
    row[family_at] = run.scene.family;
    row[scene_at] = range_of(rows);
    row[method_at] = settings_.name_of(run.method);
    std::string words;
    for (const ScaleFigure figure : all_scale_figures()) {
      const Growth growth = growth_of(rows, figure);
      if (growth.exponent) {
        row[figures_at + static_cast<std::size_t>(figure)] = *growth.exponent;
        words += (words.empty() ? "" : ", ") + words_on(figure, growth, rows.size());
      }
    }
    table_.add_row(std::move(row));
    table_.add_note("Growth, " + range_of(rows) + ", " + settings_.name_of(run.method) + ": " + words + ".");
  }

  static std::string words_on(ScaleFigure figure, const Growth& growth, std::size_t row_count) {
    const std::string points = growth.point_count < row_count
                                   ? " (" + std::to_string(growth.point_count) + " of " + counted(row_count, "row") + ")"
                                   : "";
    return column_of(figure).name + " " + fixed(*growth.exponent, exponent_digits) + points;
  }

  const ScaleSettings& settings_;
  Table& table_;
};

/// What the same method takes with the first number of nodes; nothing if that has no figures.
std::optional<double> first_render(const ScaleResult& result, const std::vector<ScaleResult>& results) {
  const auto first =
      std::find_if(results.begin(), results.end(), [&](const ScaleResult& other) { return belongs(other.run, result.run); });
  return first->figures ? (*first->figures)[ScaleFigure::render] : std::nullopt;
}

std::vector<Cell> row_of(const ScaleResult& result, const ScaleSettings& settings) {
  const ScaleRun& run = result.run;
  std::vector<Cell> row(ratio_at + 1);
  row[part_at] = std::string(name_of(run.part));
  row[family_at] = run.scene.family;
  row[scene_at] = run.scene.text();
  row[method_at] = settings.name_of(run.method);
  row[nodes_at] = std::uint64_t{run.node_count};
  row[primitives_at] = result.figures ? result.figures->primitives : core::primitive_count(run.scene);
  for (const ScaleFigure figure : all_scale_figures()) {
    if (result.figures && (*result.figures)[figure]) {
      row[figures_at + static_cast<std::size_t>(figure)] = *(*result.figures)[figure];
    }
  }
  return row;
}

void add_rows(const std::vector<ScaleResult>& results, const ScaleSettings& settings, Table& table) {
  for (const ScaleResult& result : results) {
    std::vector<Cell> row = row_of(result, settings);
    if (result.figures && result.run.part == ScalePart::nodes) {
      const auto first = first_render(result, results);
      row[ratio_at] = first && *first > 0 ? Cell(*(*result.figures)[ScaleFigure::render] / *first) : Cell();
    }
    table.add_row(std::move(row));
    if (!result.figures) {
      table.add_note(result.run.scene.text() + ", " + settings.name_of(result.run.method) + " on " +
                     counted(result.run.node_count, "node") + ": no figures. " + result.misfit + ".");
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

/// Curves of one part and family over the column `place`.
class Pictures {
 public:
  Pictures(const ScaleSettings& settings, ScalePart part, const std::string& family)
      : settings_(settings), part_(part), family_(family) {}

  /// `figures` that do not depend on the method are drawn once, the others for each method.
  Plot plot(const std::string& name, const std::string& title, const PlotAxis& y, const std::vector<ScaleFigure>& shared,
            const std::vector<ScaleFigure>& figures) const {
    std::vector<PlotSeries> series;
    for (const ScaleFigure figure : shared) {
      series.push_back(series_of(figure, settings_.methods.front(), column_of(figure).name, series.size()));
    }
    for (const ScaleFigure figure : figures) {
      for (const ScaleMethod method : settings_.methods) {
        series.push_back(series_of(figure, method, column_of(figure).name + " " + settings_.name_of(method), series.size()));
      }
    }
    const bool by_size = part_ == ScalePart::sizes;
    return curves("scale_" + (by_size ? family_ : "nodes") + "_" + name, title + (by_size ? " of " + family_ : " over nodes"),
                  by_size ? "primitives" : "nodes", by_size ? powers_of_10("primitives") : node_axis(), y, std::move(series));
  }

 private:
  PlotSeries series_of(ScaleFigure figure, ScaleMethod method, const std::string& title, std::size_t color) const {
    return {.title = title,
            .column = column_of(figure).name,
            .where = {{"part", name_of(part_)}, {"family", family_}, {"method", settings_.name_of(method)}},
            .color = color};
  }

  const ScaleSettings& settings_;
  ScalePart part_;
  std::string family_;
};

void add_plots(const Pictures& pictures, std::vector<Plot>& plots) {
  using enum ScaleFigure;
  plots.push_back(pictures.plot("seconds", "Seconds", powers_of_10("s"), {load, build}, {render}));
  plots.push_back(pictures.plot("memory", "Memory", powers_of_10("MB"), {database}, {memory, local_memory}));
  plots.push_back(pictures.plot("traffic", "Traffic", powers_of_10("a ray"), {}, {faults, moves}));
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
  GrowthRows growth(settings, table);
  for (const Group& group : groups_of(results)) {
    growth.add(group);
  }
  return table;
}

std::string scale_conclusion(const Table& table) {
  const auto exponent = [&](const std::vector<Cell>& row, ScaleFigure figure) {
    const auto number = number_in(table, row, column_of(figure).name);
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
            exponent(*row, ScaleFigure::build) + ", rendering of " + exponent(*row, ScaleFigure::render) + ", memory of " +
            exponent(*row, ScaleFigure::memory) + ". ";
  }
  if (const auto row = first("growth by nodes"); row != table.rows().end()) {
    const std::vector<std::string> texts = texts_of(table, *row);
    text += "For " + texts[scene_at] + " by " + texts[method_at] + " rendering takes nodes to the power of " +
            exponent(*row, ScaleFigure::render) + ". ";
  }
  return text.substr(0, text.empty() ? 0 : text.size() - 1);
}

std::vector<Plot> scale_plots(const ScaleSettings& settings) {
  std::vector<Plot> plots;
  for (const ScalePart part : settings.parts) {
    const std::vector<std::string> of_nodes = {settings.scene_of_nodes().family};
    for (const std::string& family : part == ScalePart::sizes ? settings.families : of_nodes) {
      add_plots(Pictures(settings, part, family), plots);
    }
  }
  return plots;
}

}  // namespace dmpc::apps
