#include "apps/frontend/table/plot.h"

#include <algorithm>
#include <set>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/table/drawn_plot.h"

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

/// Gap between the bars of adjacent positions, in positions.
constexpr double gap = 0.2;

class Script : private DrawnPlot {
 public:
  Script(const Plot& plot, const Table& table, const std::string& data_file) : DrawnPlot(plot, table), data_(data_file) {}

  std::optional<std::string> text() const {
    if (drawn_.empty()) {
      return std::nullopt;
    }
    return head() +
           (has_places() ? axis_lines("x", plot_.x) : axis_lines("x", plot_.x, span_of_x(), unit_of(plot_.places.front()))) +
           axis_lines("y", plot_.y, span_of_y(), unit_of(drawn_.front()->column)) + bars() + quoted_texts() + curves();
  }

 private:
  std::string head() const {
    return "# Draws " + plot_.name + ".svg from " + data_ + ": gnuplot " + plot_.name +
           ".gnuplot\n"
           "reset\n"
           "set encoding utf8\n"
           "set datafile separator ','\n"
           "set datafile missing NaN\n"
           "set terminal svg size 960,600 noenhanced font 'sans-serif,14' background '#ffffff'\n"
           "set output " +
           gnuplot_text(plot_.name + ".svg") + "\nset title " + gnuplot_text(plot_.title) +
           "\nset key outside right top Left reverse\n"
           "set border 3\nset tics nomirror\nset grid ytics linecolor '#dddddd'\n";
  }

  std::string bars() const {
    return is_bars_
               ? (has_places() ? positions() : "") + "set style fill solid\nset boxwidth " + legend_number(bar_width()) + "\n"
               : "";
  }

  /// Returns the positions of bars, from 1 on.
  std::string positions() const {
    const std::string count = std::to_string(places_.size());
    std::string names, tics;
    std::size_t longest = 0;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      names += (place == 0 ? "" : ", ") + gnuplot_text(places_[place]);
      tics += (place == 0 ? "" : ", ") + gnuplot_tic(places_[place], std::to_string(place + 1));
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

  std::string data_;
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

PlotAxis percent_axis(const std::string& what) { return {.label = what + " (%)", .least = 0, .most = 105}; }

std::optional<std::string> script_of(const Plot& plot, const Table& table, const std::string& data_file) {
  return Script(plot, table, data_file).text();
}

}  // namespace dmpc::apps
