#include "apps/frontend/table/plot.h"

#include <algorithm>
#include <set>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/table/plot_axis.h"
#include "core/base/expect.h"

namespace dmpc::apps {

/// M. Okabe and K. Ito, "Color Universal Design", 2008, with a brown in place of their yellow, which is faint on white.
const std::array<const char*, 8> plot_colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000", "#8C6D46"};

namespace {

/// gnuplot's indices of filled and open shapes.
constexpr std::array<int, plot_color_count> shapes = {7, 5, 9, 13, 11, 15, 6, 4, 8, 12, 10, 14};
/// gnuplot's indices of hatches that look different.
constexpr std::array<int, 4> hatches = {4, 5, 2, 7};

/// Background of a hatch: light enough for each of the colours.
constexpr const char* hatch_ground = "#eeeeee";

constexpr const char* next_line = ", \\\n  ";

/// Names of positions along x up to this length are upright.
constexpr std::size_t upright_letters_max = 3;
/// Names of positions along x that can be distinguished in little space.
constexpr std::size_t small_names_max = 24;

/// Gap between the bars of adjacent positions, in positions.
constexpr double gap = 0.2;

/// Returns a name of a position as in the CSV file: a text or a whole number.
std::string text_of_cell(const Cell& cell) {
  const std::string* const text = std::get_if<std::string>(&cell);
  const std::uint64_t* const number = std::get_if<std::uint64_t>(&cell);
  core::expect(text != nullptr || number != nullptr, "a place in a plot has a name or a whole number");
  const std::string name = text != nullptr ? *text : std::to_string(*number);
  core::expect(name.find_first_of("\r\n") == std::string::npos, "a place in a plot has a name of one line");
  return name;
}

bool stands_at_place(const PlotSeries& series) { return series.mark == PlotMark::bars || series.mark == PlotMark::bands; }

class Script {
 public:
  Script(const Plot& plot, const Table& table, const std::string& data_file) : plot_(plot), table_(table), data_(data_file) {
    is_bars_ = std::any_of(plot.series.begin(), plot.series.end(), stands_at_place);
    for (const PlotSeries& series : plot.series) {
      core::expect(stands_at_place(series) == is_bars_, "the series of a plot are all bars or bands, or none is");
      core::expect(series.color < plot_color_count, "a plot has so many colours");
      if (std::any_of(table.rows().begin(), table.rows().end(), [&](const auto& row) { return is_meant(series, row); })) {
        drawn_.push_back(&series);
      }
    }
    for (const std::vector<Cell>& row : table.rows()) {
      if (has_places() && std::any_of(drawn_.begin(), drawn_.end(), [&](const auto* series) { return is_meant(*series, row); })) {
        add_place(row);
      }
    }
    core::expect(has_places() || plot.places.size() == 1, "numbers along x are of one column");
  }

  std::optional<std::string> text() const {
    if (drawn_.empty()) {
      return std::nullopt;
    }
    return head() +
           (has_places() ? axis_lines("x", plot_.x) : axis_lines("x", plot_.x, span_of_x(), unit_of(plot_.places.front()))) +
           axis_lines("y", plot_.y, span_of_y(), unit_of(drawn_.front()->column)) + bars() + quoted_texts() + curves();
  }

 private:
  bool is_meant(const PlotSeries& series, const std::vector<Cell>& row) const {
    return is_visible(row[number_of_column(table_, series.column)]) &&
           std::all_of(series.where.begin(), series.where.end(), [&](const auto& condition) {
             return text_of_cell(row[number_of_column(table_, condition.first)]) == condition.second;
           });
  }

  /// Returns whether the axis can show a cell's number.
  bool is_visible(const Cell& cell) const {
    const std::optional<double> number = number_of(cell);
    return number && (plot_.y.scale == PlotScale::linear || *number > 0);
  }

  void add_place(const std::vector<Cell>& row) {
    const std::string name =
        joined(plot_.places, " ", [&](const std::string& column) { return text_of_cell(row[number_of_column(table_, column)]); });
    if (std::find(places_.begin(), places_.end(), name) == places_.end()) {
      places_.push_back(name);
    }
  }

  /// Returns whether bars stand at named positions.
  bool has_places() const { return is_bars_ && !plot_.bar_width; }

  const std::string& unit_of(const std::string& column) const { return table_.columns()[number_of_column(table_, column)].unit; }

  double number_in(const std::vector<Cell>& row, const std::string& column) const {
    return number_of(row[number_of_column(table_, column)]).value_or(0);
  }

  PlotExtent span_of_x() const {
    PlotExtent extent;
    for (const std::vector<Cell>& row : table_.rows()) {
      if (std::any_of(drawn_.begin(), drawn_.end(), [&](const auto* series) { return is_meant(*series, row); })) {
        const double x = number_in(row, plot_.places.front());
        extent.add(x);
        extent.add(x + plot_.bar_width.value_or(0));
      }
    }
    return extent;
  }

  static std::vector<std::string> ends_of(const PlotSeries& series) {
    const bool has_ends = series.mark == PlotMark::intervals || series.mark == PlotMark::bands;
    return has_ends ? std::vector{series.low, series.high} : std::vector<std::string>{};
  }

  PlotExtent span_of_y() const {
    PlotExtent extent;
    for (const std::vector<Cell>& row : table_.rows()) {
      double sum = 0;
      for (const PlotSeries* series : drawn_) {
        if (is_meant(*series, row)) {
          const double value = number_in(row, series->column);
          sum = plot_.is_stacked ? sum + value : value;
          extent.add(sum);
          for (const std::string& end : ends_of(*series)) {
            extent.add(number_in(row, end));
          }
        }
      }
    }
    return extent;
  }

  bool is_small() const { return plot_.size == PlotSize::small; }

  std::string head() const {
    return "# Draws " + plot_.name + ".svg from " + data_ + ": gnuplot " + plot_.name +
           ".gnuplot\n"
           "reset\n"
           "set encoding utf8\n"
           "set datafile separator ','\n"
           "set datafile missing NaN\n"
           "set terminal svg size " +
           (is_small() ? "480," + std::to_string(small_height()) + " noenhanced font 'sans-serif,13'"
                       : "960,600 noenhanced font 'sans-serif,14'") +
           " background '#ffffff'\n"
           "set output " +
           gnuplot_text(plot_.name + ".svg") + "\nset title " + gnuplot_text(plot_.title) + "\nset key " + key() +
           "\n"
           "set border 3\nset tics nomirror\nset grid ytics linecolor '#dddddd'\n" +
           (is_small() ? "set xlabel offset 0,0.5\n" : "");
  }

  /// Returns the height that gives the plot enough space beside the legend and the names below.
  std::size_t small_height() const {
    constexpr std::size_t plot_height = 270, line_height = 18, letter_width = 7;
    std::size_t longest_name = 0, longest_title = 0;
    for (const std::string& name : places_) {
      longest_name = std::max(longest_name, name.size());
    }
    for (const PlotSeries* series : drawn_) {
      longest_title = std::max(longest_title, series->title.size());
    }
    const std::size_t titles_in_line = longest_title > 20 ? 1 : 2;
    return plot_height + line_height * ((drawn_.size() + 1) / titles_in_line) + letter_width * longest_name;
  }

  std::string key() const {
    const bool needs_none = is_small() && drawn_.size() == 1;  // the title has it
    return needs_none ? "off" : is_small() ? "bmargin center horizontal Left reverse" : "outside right top Left reverse";
  }

  std::string bars() const {
    return is_bars_ ? (has_places() ? places() : "") + "set style fill solid\nset boxwidth " + legend_number(bar_width()) + "\n"
                    : "";
  }

  /// Returns 1, 2 or 5 times a power of ten, so that every name at a multiple of it has space; a large plot has all names.
  std::size_t name_step() const {
    for (std::size_t power = 1; is_small(); power *= 10) {
      for (const std::size_t digit : {1U, 2U, 5U}) {
        if (places_.size() <= digit * power * small_names_max) {
          return digit * power;
        }
      }
    }
    return 1;
  }

  /// Returns the positions of bars, from 1 on.
  std::string places() const {
    const std::string count = std::to_string(places_.size());
    const std::size_t step = name_step();
    std::string names, tics;
    std::size_t longest = 0;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      names += (place == 0 ? "" : ", ") + gnuplot_text(places_[place]);
      if (place % step == 0) {
        tics += (place == 0 ? "" : ", ") + gnuplot_tic(places_[place], std::to_string(place + 1));
      }
      longest = std::max(longest, places_[place].size());
    }
    return "array names[" + count + "] = [" + names + "]\nplace_of(name) = sum [i = 1:" + count +
           "] (name eq names[i] ? i : 0)\nset xtics " + (longest > upright_letters_max ? "rotate by 60 right " : "") +
           "nomirror (" + tics + ")\nset xrange [0.4:" + count + ".6]\n";
  }

  double bar_width() const {
    return plot_.bar_width ? *plot_.bar_width : (1 - gap) / static_cast<double>(plot_.is_stacked ? 1 : drawn_.size());
  }

  /// Returns the column by its heading, unless gnuplot would not find that: it takes two quotes in a file literally.
  std::string column(const std::string& name) const {
    const std::size_t number = number_of_column(table_, name);
    const std::string head = header_of(table_.columns()[number]);
    return head.find('"') == std::string::npos ? gnuplot_text(head) : std::to_string(number + 1);
  }

  /// gnuplot ends a text at its first comma or quote, despite CSV's quoting: such columns are written into the script, row by
  /// row.
  bool is_quoted(const std::string& name) const {
    const std::size_t number = number_of_column(table_, name);
    return std::any_of(table_.rows().begin(), table_.rows().end(), [&](const auto& row) {
      const auto* const text = std::get_if<std::string>(&row[number]);
      return text != nullptr && csv_text(*text) != *text;
    });
  }

  std::string array_of(const std::string& name) const { return "texts" + std::to_string(number_of_column(table_, name) + 1); }

  std::string quoted_texts() const {
    std::set<std::string> names;
    for (const PlotSeries* series : drawn_) {
      for (const auto& [name, text] : series->where) {
        names.insert(name);
      }
    }
    if (has_places()) {
      names.insert(plot_.places.begin(), plot_.places.end());
    }
    return joined(names, "", [&](const std::string& name) {
      return is_quoted(name)
                 ? "array " + array_of(name) + "[" + std::to_string(table_.rows().size()) + "] = [" + texts_by_row(name) + "]\n"
                 : "";
    });
  }

  std::string texts_by_row(const std::string& name) const {
    std::string texts;
    for (const std::vector<Cell>& row : table_.rows()) {
      const auto* const text = std::get_if<std::string>(&row[number_of_column(table_, name)]);
      texts += (texts.empty() ? "" : ", ") + gnuplot_text(text == nullptr ? "" : *text);
    }
    return texts;
  }

  std::string text_in(const std::string& name) const {
    return is_quoted(name) ? array_of(name) + "[int(column(0)) + 1]" : "stringcolumn(" + column(name) + ")";
  }

  std::string x_of(std::size_t series) const {
    if (!has_places()) {
      const std::string x = "column(" + column(plot_.places.front()) + ")";
      return plot_.bar_width ? x + " + " + legend_number(*plot_.bar_width / 2) : x;
    }
    const std::string name = joined(plot_.places, ".' '.", [&](const std::string& place) { return text_in(place); });
    const double middle = (static_cast<double>(drawn_.size()) - 1) / 2;
    const double shift = plot_.is_stacked ? 0 : (static_cast<double>(series) - middle) * bar_width();
    return "place_of(" + name + ")" + (shift == 0 ? "" : " + " + legend_number(shift));
  }

  /// Returns the series' own column, added to those below it if they are stacked.
  std::string y_of(std::size_t series) const {
    std::string sum;
    for (std::size_t below = plot_.is_stacked ? 0 : series; below <= series; ++below) {
      sum += (sum.empty() ? "" : " + ") + ("column(" + column(drawn_[below]->column) + ")");
    }
    std::string condition;
    for (const auto& [name, text] : drawn_[series]->where) {
      condition += (condition.empty() ? "" : " && ") + text_in(name) + " eq " + gnuplot_text(text);
    }
    return condition.empty() ? sum : condition + " ? " + sum + " : NaN";
  }

  /// Returns the box with its lines to both ends, and above it one so flat that it is a line.
  std::string band(std::size_t series, const std::string& color) const {
    const PlotSeries& drawn = *drawn_[series];
    const auto box = [&](const std::string& low, const std::string& least, const std::string& most, const std::string& high) {
      std::string numbers = gnuplot_text(data_) + " using (" + x_of(series) + ")";
      for (const std::string& name : {low, least, most, high}) {
        numbers += ":(column(" + column(name) + "))";
      }
      return numbers + " with candlesticks linecolor '" + color + "'";
    };
    return box(drawn.box_low, drawn.low, drawn.high, drawn.box_high) + " fillstyle solid 0.4 title " + gnuplot_text(drawn.title) +
           " whiskerbars 0.5" + next_line + box(drawn.column, drawn.column, drawn.column, drawn.column) + " linewidth 3 notitle";
  }

  static bool is_hatched(const PlotSeries& series) { return series.mark == PlotMark::bars && series.color >= plot_colors.size(); }

  std::string style_of(const PlotSeries& series) const {
    const bool is_again = series.color >= plot_colors.size();
    const std::size_t color_number = series.color % plot_colors.size();
    const std::string color = " linecolor '" + std::string(plot_colors[color_number]) + "'";
    const std::string shape = " pointtype " + std::to_string(shapes[series.color]);
    switch (series.mark) {
      case PlotMark::bars:
        return "boxes" + color + (is_again ? " fillstyle pattern " + std::to_string(hatches[color_number]) : "");
      case PlotMark::intervals:
        return "yerrorbars linewidth 1.5" + shape + " pointsize 0.6" + color;
      case PlotMark::points:
        return "points" + shape + " pointsize 1.1" + color;
      default:
        return "linespoints linewidth 2" + std::string(is_again ? " dashtype 2" : "") + shape + " pointsize 0.4" + color;
    }
  }

  /// Returns the layers of a series: a hatch is transparent and needs a background, and intervals have their line below them.
  std::string elements(std::size_t series) const {
    const PlotSeries& drawn = *drawn_[series];
    if (drawn.mark == PlotMark::bands) {
      return band(series, plot_colors[drawn.color % plot_colors.size()]);
    }
    const std::string ends = joined(ends_of(drawn), "", [&](const std::string& end) { return ":(column(" + column(end) + "))"; });
    const std::string points = gnuplot_text(data_) + " using (" + x_of(series) + "):(" + y_of(series) + ")";
    const std::string numbers = points + ends + (drawn.mark == PlotMark::line ? " smooth unique" : "") + " with ";
    const std::string below = is_hatched(drawn) ? numbers + "boxes linecolor '" + hatch_ground + "' notitle" + next_line
                              : drawn.mark == PlotMark::intervals
                                  ? points + " smooth unique with lines linewidth 2 linecolor '" +
                                        plot_colors[drawn.color % plot_colors.size()] + "' notitle" + next_line
                                  : "";
    return below + numbers + style_of(drawn) + " title " + gnuplot_text(drawn.title);
  }

  /// Stacked bars are drawn from the top down, so that each covers the part below.
  std::string curves() const {
    std::string text = "plot ";
    for (std::size_t drawn = 0; drawn < drawn_.size(); ++drawn) {
      text += (drawn == 0 ? "" : next_line) + elements(plot_.is_stacked ? drawn_.size() - 1 - drawn : drawn);
    }
    return text + "\n";
  }

  const Plot& plot_;
  const Table& table_;
  std::string data_;
  bool is_bars_ = false;
  std::vector<const PlotSeries*> drawn_;  ///< series that have a row
  std::vector<std::string> places_;       ///< names of bars
};

}  // namespace

Plot curves(std::string name, std::string title, std::string place, PlotAxis x, PlotAxis y, std::vector<PlotSeries> series) {
  Plot plot;
  plot.name = std::move(name);
  plot.title = std::move(title);
  plot.places.push_back(std::move(place));
  plot.x = std::move(x);
  plot.y = std::move(y);
  plot.series = std::move(series);
  return plot;
}

Plot bars_by_node(std::string name, std::string title, PlotAxis y, std::vector<PlotSeries> series, bool is_stacked) {
  for (PlotSeries& one : series) {
    one.mark = PlotMark::bars;
  }
  Plot plot = curves(std::move(name), std::move(title), "node", {.label = "node"}, std::move(y), std::move(series));
  plot.is_stacked = is_stacked;
  return plot;
}

Plot stacked_by_node(std::string name, std::string title, PlotAxis y, const std::vector<Column>& columns) {
  std::vector<PlotSeries> series;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    series.push_back({.title = columns[i].name, .column = columns[i].name, .color = (i - 1) % plot_color_count});
  }
  return bars_by_node(std::move(name), std::move(title), std::move(y), std::move(series), true);
}

PlotAxis node_axis() { return {.label = "nodes", .scale = PlotScale::powers_of_2}; }

PlotAxis percent_axis(const std::string& what) { return {.label = what + " (%)", .least = 0, .most = 105}; }

std::optional<std::string> script_of(const Plot& plot, const Table& table, const std::string& data_file) {
  return Script(plot, table, data_file).text();
}

}  // namespace dmpc::apps
