#include "apps/lab/study/sweep/table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/lab/figures/known_figures.h"
#include "apps/lab/study/engine/render_process.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

/// The type of a variation's values.
enum class ValueKind : std::uint8_t { counts, sizes, texts };

std::optional<std::uint64_t> size_in(const std::string& text) {
  try {
    return parse_size_bytes(text, "");
  } catch (const core::UsageError&) {
    return std::nullopt;
  }
}

ValueKind kind_of(const VariedOption& variation) {
  const auto all = [&](const auto& is_one) { return std::all_of(variation.values.begin(), variation.values.end(), is_one); };
  return all([](const std::string& text) { return number_in<std::uint64_t>(text).has_value(); }) ? ValueKind::counts
         : all([](const std::string& text) { return size_in(text).has_value(); })                ? ValueKind::sizes
                                                                                                 : ValueKind::texts;
}

Cell cell_of(const VariedOption& variation, const std::string& value) {
  const ValueKind kind = kind_of(variation);
  return kind == ValueKind::counts  ? Cell(*number_in<std::uint64_t>(value))
         : kind == ValueKind::sizes ? Cell(*size_in(value))
                                    : Cell(value);
}

/// Returns "page-size" for "--page-size".
std::string name_of(const VariedOption& variation) { return variation.option.substr(2); }

bool ends_in(const std::string& name, const std::string& word) { return name == word || name.ends_with("." + word); }

std::string unit_of(const std::string& figure) {
  const std::vector<std::string> words = words_between(figure, '.');
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  return has("seconds") || has("virtual_seconds")                     ? "s"
         : has("time_percent")                                        ? "%"
         : ends_in(figure, "bytes") || has("memory")                  ? "bytes"
         : figure.ends_with("_bytes") || ends_in(figure, "page_size") ? "bytes"
         : figure.ends_with("_ps")                                    ? "ps"
                                                                      : "";
}

struct ValueCell {
  Cell operator()(std::monostate) const { return {}; }
  Cell operator()(bool value) const { return std::string(value ? "true" : "false"); }
  template <class Value>
  Cell operator()(const Value& value) const {
    return value;
  }
};

Cell cell_of(const SweepResult& result, const std::string& figure) {
  if (!result.figures) {
    return {};
  }
  const FigureValue* const value = find_value(*result.figures, figure);
  return value == nullptr ? Cell() : std::visit(ValueCell(), *value);
}

/// Returns the decimal places that give the largest of a column's numbers four digits.
int digits_of(const std::vector<SweepResult>& results, const std::string& figure) {
  double most = 0;
  for (const SweepResult& result : results) {
    const Cell cell = cell_of(result, figure);
    if (const double* const number = std::get_if<double>(&cell)) {
      most = std::max(most, std::abs(*number));
    }
  }
  constexpr int digits = 4, digits_max = 9;
  return most > 0 ? std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(most))), 0, digits_max) : 0;
}

std::vector<Column> columns_of(const SweepSettings& settings, const std::vector<std::string>& figures,
                               const std::vector<SweepResult>& results) {
  std::vector<Column> columns = core::mapped<Column>(settings.variations, [&](const VariedOption& variation) {
    return Column{name_of(variation), kind_of(variation) == ValueKind::sizes ? "bytes" : ""};
  });
  for (const std::string& figure : figures) {
    columns.push_back({figure, unit_of(figure), digits_of(results, figure)});
  }
  return columns;
}

std::string title_of(const SweepSettings& settings) {
  return "Study sweep of " + settings.scene + (settings.fixed.empty() ? "" : ": ") + joined(settings.fixed, " ");
}

void add_notes(const SweepSettings& settings, const std::vector<SweepResult>& results, Table& table) {
  std::size_t kept = 0;
  std::set<std::string> of_prices;
  for (const SweepResult& result : results) {
    kept += result.is_kept ? 1 : 0;
    const RenderOptions& options = result.run.options;
    if (options.runner.kind == RunnerKind::virtual_time) {
      of_prices.insert(price_note(load_machine(options.runner.machine_name).machine, options.database.build.structure));
    }
    if (!result.figures) {
      table.add_note("No room with " + text_of(settings.variations, result.run) + ": " + result.misfit + ".");
    }
  }
  for (const std::string& note : of_prices) {
    if (!note.empty()) {
      table.add_note(note + ".");
    }
  }
  if (kept > 0) {
    table.add_note(grouped(kept) + " of " + counted(results.size(), "run") + " kept from before.");
  }
}

bool any(const std::vector<SweepRun>& runs, bool (*holds)(const RenderOptions&)) {
  return std::any_of(runs.begin(), runs.end(), [&](const SweepRun& run) { return holds(run.options); });
}

/// One of several in a picture.
struct SweepCurve {
  std::string title;                                       ///< the variation as typed: "page-size 1KiB"
  std::vector<std::pair<std::string, std::string>> where;  ///< selects its rows
};

/// Returns `curve` restricted to one value of another variation.
SweepCurve narrowed(SweepCurve curve, const VariedOption& variation, const std::string& value) {
  const Cell cell = cell_of(variation, value);
  const auto* const number = std::get_if<std::uint64_t>(&cell);
  curve.title += (curve.title.empty() ? "" : ", ") + name_of(variation) + " " + value;
  curve.where.emplace_back(name_of(variation), number != nullptr ? std::to_string(*number) : value);
  return curve;
}

/// Returns curves for all combinations of the variations except `along`; one without a title if there is no other.
std::vector<SweepCurve> curves_of(const std::vector<VariedOption>& variations, const VariedOption* along) {
  std::vector<SweepCurve> curves(1);
  for (const VariedOption& variation : variations) {
    if (&variation == along || variation.values.size() == 1) {
      continue;
    }
    std::vector<SweepCurve> longer;
    for (const SweepCurve& curve : curves) {
      for (const std::string& value : variation.values) {
        longer.push_back(narrowed(curve, variation, value));
      }
    }
    curves = std::move(longer);
  }
  return curves;
}

PlotScale scale_along(const VariedOption& along) {
  std::uint64_t least = ~std::uint64_t{0}, most = 0;
  for (const std::string& value : along.values) {
    const std::uint64_t number = std::get<std::uint64_t>(cell_of(along, value));
    least = std::min(least, number);
    most = std::max(most, number);
  }
  return least > 0 && most / least >= 8 ? PlotScale::powers_of_2 : PlotScale::linear;
}

Plot plot_of(const std::string& figure, const SweepSettings& settings, const VariedOption* along) {
  std::string file = figure;
  std::replace(file.begin(), file.end(), '.', '-');
  const std::string title = figure + " of " + settings.scene;
  const PlotAxis y{header_of({figure, unit_of(figure)}), PlotScale::linear, 0};
  if (along == nullptr) {
    Plot bars{.name = file, .title = title, .places = {}, .x = {""}, .y = y, .series = {{figure, figure, {}, PlotMark::bars}}};
    for (const VariedOption& variation : settings.variations) {
      bars.places.push_back(name_of(variation));
    }
    return bars;
  }
  std::vector<PlotSeries> series;
  for (const SweepCurve& curve : curves_of(settings.variations, along)) {
    series.push_back({curve.title.empty() ? figure : curve.title, figure, curve.where, PlotMark::line, series.size()});
  }
  const std::string unit = kind_of(*along) == ValueKind::sizes ? "bytes" : "";
  return curves(file, title, name_of(*along), {header_of({name_of(*along), unit}), scale_along(*along)}, y, std::move(series));
}

}  // namespace

std::vector<std::string> figures_of(const SweepSettings& settings, const std::vector<SweepRun>& runs) {
  if (!settings.columns.empty()) {
    return settings.columns;
  }
  std::vector<std::string> figures;
  const auto add = [&](const char* figure, bool is_of_use) {
    if (is_of_use) {
      figures.emplace_back(figure);
    }
  };
  add("virtual_seconds.total", any(runs, [](const RenderOptions& run) { return run.runner.kind == RunnerKind::virtual_time; }));
  add("seconds.render", any(runs, is_timed_by_the_wall));
  add("rays.total", true);
  add("packets.sent", true);
  add("packets.bytes", true);
  add("pages.faults", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::svm; }));
  add("questions.rays_asked", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::forest; }));
  add("travel.messages_per_ray", any(runs, [](const RenderOptions& run) { return run.strategy == Strategy::dataflow; }));
  return figures;
}

Table sweep_table(const SweepSettings& settings, const std::vector<SweepRun>& runs, const std::vector<SweepResult>& results) {
  const std::vector<std::string> figures = figures_of(settings, runs);
  Table table(title_of(settings), columns_of(settings, figures, results));
  for (const SweepResult& result : results) {
    std::vector<Cell> row;
    for (std::size_t i = 0; i < settings.variations.size(); ++i) {
      row.push_back(cell_of(settings.variations[i], result.run.values[i]));
    }
    for (const std::string& figure : figures) {
      row.push_back(cell_of(result, figure));
    }
    table.add_row(std::move(row));
  }
  add_notes(settings, results, table);
  return table;
}

std::vector<Plot> sweep_plots(const SweepSettings& settings, const std::vector<SweepRun>& runs) {
  const VariedOption* along = nullptr;
  for (const VariedOption& variation : settings.variations) {
    if (along == nullptr && variation.values.size() > 1 && kind_of(variation) != ValueKind::texts) {
      along = &variation;
    }
  }
  std::vector<Plot> plots;
  for (const std::string& figure : figures_of(settings, runs)) {
    const bool is_distinguished = along == nullptr || curves_of(settings.variations, along).size() <= plot_color_count;
    if (is_number(figure) && is_distinguished) {
      plots.push_back(plot_of(figure, settings, along));
    }
  }
  return plots;
}

}  // namespace dmpc::apps
