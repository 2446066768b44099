#include "apps/plot.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iomanip>
#include <sstream>

#include "core/expect.h"

namespace dmpc::apps {
namespace {

/// M. Okabe and K. Ito, "Color Universal Design", 2008, without their yellow, which is faint on white.
constexpr std::array<const char*, plot_color_count> colors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                              "#E69F00", "#56B4E9", "#000000", "#999999"};
/// gnuplot's numbers of filled and open shapes.
constexpr std::array<int, plot_color_count> shapes = {7, 5, 9, 13, 11, 15, 6, 4};

/// Names of places along x that can be told apart, where there is little room.
constexpr std::size_t small_names_max = 24;

/// Between the bars of one place and those of the next, in places.
constexpr double gap = 0.2;

/// Without more digits than it needs.
std::string shortest(double number) {
  std::ostringstream text;
  text << std::setprecision(4) << number;
  return text.str();
}

/// A text as gnuplot reads it, on one line.
std::string quoted(const std::string& text) {
  std::string safe = "'";
  for (const char character : text) {
    const bool is_control = std::iscntrl(static_cast<unsigned char>(character)) != 0;
    safe += character == '\'' ? "''" : std::string(1, is_control ? ' ' : character);
  }
  return safe + "'";
}

std::size_t number_of_column(const Table& table, const std::string& name) {
  const auto& columns = table.columns();
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  core::expect(found != columns.end(), "a plot is of columns that its table has");
  return static_cast<std::size_t>(found - columns.begin());
}

/// A name that is a place in the picture, as it stands in the CSV file: a text or a whole number.
std::string text_of_cell(const Cell& cell) {
  const std::string* const text = std::get_if<std::string>(&cell);
  const std::uint64_t* const number = std::get_if<std::uint64_t>(&cell);
  core::expect(text != nullptr || number != nullptr, "a place in a plot has a name or a whole number");
  const std::string name = text != nullptr ? *text : std::to_string(*number);
  core::expect(name.find_first_of(",\"\r\n") == std::string::npos, "a place in a plot has a name that CSV need not quote");
  return name;
}

/// Writes one plot's script.
class Script {
 public:
  Script(const Plot& plot, const Table& table, const std::string& data_file) : plot_(plot), table_(table), data_(data_file) {
    is_bars_ = std::any_of(plot.series.begin(), plot.series.end(), [](const auto& one) { return one.mark == PlotMark::bars; });
    for (const PlotSeries& series : plot.series) {
      core::expect((series.mark == PlotMark::bars) == is_bars_, "the series of a plot are all bars, or none is");
      core::expect(series.color < colors.size(), "a plot has eight colours");
      if (std::any_of(table.rows().begin(), table.rows().end(), [&](const auto& row) { return is_meant(series, row); })) {
        drawn_.push_back(&series);
      }
    }
    for (const std::vector<Cell>& row : table.rows()) {
      if (is_bars_ && std::any_of(drawn_.begin(), drawn_.end(), [&](const auto* series) { return is_meant(*series, row); })) {
        add_place(row);
      }
    }
    core::expect(is_bars_ || plot.places.size() == 1, "a curve has one column along x");
  }

  std::optional<std::string> text() const {
    if (drawn_.empty()) {
      return std::nullopt;
    }
    return head() + axis("x", plot_.x) + axis("y", plot_.y) + (is_bars_ ? places() : "") + curves();
  }

 private:
  bool is_meant(const PlotSeries& series, const std::vector<Cell>& row) const {
    return is_visible(row[number_of_column(table_, series.column)]) &&
           std::all_of(series.where.begin(), series.where.end(), [&](const auto& condition) {
             return text_of_cell(row[number_of_column(table_, condition.first)]) == condition.second;
           });
  }

  /// A number that the axis has a place for.
  bool is_visible(const Cell& cell) const {
    const double* const real = std::get_if<double>(&cell);
    const std::uint64_t* const whole = std::get_if<std::uint64_t>(&cell);
    const bool is_positive = (real != nullptr && *real > 0) || (whole != nullptr && *whole > 0);
    return plot_.y.scale == PlotScale::linear ? real != nullptr || whole != nullptr : is_positive;
  }

  void add_place(const std::vector<Cell>& row) {
    std::string name;
    for (const std::string& column : plot_.places) {
      name += (name.empty() ? "" : " ") + text_of_cell(row[number_of_column(table_, column)]);
    }
    if (std::find(places_.begin(), places_.end(), name) == places_.end()) {
      places_.push_back(name);
    }
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
           quoted(plot_.name + ".svg") + "\nset title " + quoted(plot_.title) + "\nset key " + key() +
           "\n"
           "set grid ytics linecolor '#dddddd'\n";
  }

  /// So high that legend and names below leave the plot its room.
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
    const bool needs_none = is_small() && drawn_.size() == 1;  // the title says it
    return needs_none ? "off" : is_small() ? "bmargin center horizontal Left reverse" : "outside right top Left reverse";
  }

  static std::string axis(const std::string& name, const PlotAxis& axis) {
    const auto end = [](const std::optional<double>& limit) { return limit ? shortest(*limit) : "*"; };
    const std::string base = axis.scale == PlotScale::powers_of_2 ? " 2" : " 10";
    return "set " + name + "label " + quoted(axis.label) + "\nset " + name + "range [" + end(axis.least) + ":" + end(axis.most) +
           "]\n" + (axis.scale == PlotScale::linear ? "" : "set logscale " + name + base + "\n");
  }

  /// Those of bars, from 1 on; where there is little room for names, every so many is named.
  std::string places() const {
    const std::string count = std::to_string(places_.size());
    const std::size_t step = is_small() ? (places_.size() + small_names_max - 1) / small_names_max : 1;
    std::string names, tics;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      names += (place == 0 ? "" : ", ") + quoted(places_[place]);
      if (place % step == 0) {
        tics += (place == 0 ? "" : ", ") + quoted(places_[place]) + " " + std::to_string(place + 1);
      }
    }
    return "array names[" + count + "] = [" + names + "]\nplace_of(name) = sum [i = 1:" + count +
           "] (name eq names[i] ? i : 0)\nset xtics rotate by 60 right nomirror (" + tics + ")\nset xrange [0.4:" + count +
           ".6]\nset style fill solid\nset boxwidth " + shortest(bar_width()) + "\n";
  }

  double bar_width() const { return (1 - gap) / static_cast<double>(plot_.is_stacked ? 1 : drawn_.size()); }

  std::string column(const std::string& name) const {
    const Column& column = table_.columns()[number_of_column(table_, name)];
    return quoted(header_of(column));
  }

  std::string x_of(std::size_t series) const {
    if (!is_bars_) {
      return "column(" + column(plot_.places.front()) + ")";
    }
    std::string name;
    for (const std::string& place : plot_.places) {
      name += (name.empty() ? "" : ".' '.") + ("stringcolumn(" + column(place) + ")");
    }
    const double middle = (static_cast<double>(drawn_.size()) - 1) / 2;
    const double shift = plot_.is_stacked ? 0 : (static_cast<double>(series) - middle) * bar_width();
    return "place_of(" + name + ")" + (shift == 0 ? "" : " + " + shortest(shift));
  }

  /// Its own column, with those below it if they are stacked.
  std::string y_of(std::size_t series) const {
    std::string sum;
    for (std::size_t below = plot_.is_stacked ? 0 : series; below <= series; ++below) {
      sum += (sum.empty() ? "" : " + ") + ("column(" + column(drawn_[below]->column) + ")");
    }
    std::string condition;
    for (const auto& [name, text] : drawn_[series]->where) {
      condition += (condition.empty() ? "" : " && ") + ("stringcolumn(" + column(name) + ") eq " + quoted(text));
    }
    return condition.empty() ? sum : condition + " ? " + sum + " : NaN";
  }

  std::string style_of(const PlotSeries& series) const {
    const std::string color = " linecolor '" + std::string(colors[series.color]) + "'";
    const std::string shape = " pointtype " + std::to_string(shapes[series.color]);
    switch (series.mark) {
      case PlotMark::bars:
        return "boxes" + color;
      case PlotMark::points:
        return "points" + shape + " pointsize 1.1" + color;
      default:
        return "linespoints linewidth 2" + shape + " pointsize 0.4" + color;
    }
  }

  /// Stacked bars are drawn from the top down, so that each covers what is not its own.
  std::string curves() const {
    std::string text = "plot ";
    for (std::size_t drawn = 0; drawn < drawn_.size(); ++drawn) {
      const std::size_t series = plot_.is_stacked ? drawn_.size() - 1 - drawn : drawn;
      text += (drawn == 0 ? "" : ", \\\n  ") + quoted(data_) + " using (" + x_of(series) + "):(" + y_of(series) + ")" +
              (drawn_[series]->mark == PlotMark::line ? " smooth unique" : "") + " with " + style_of(*drawn_[series]) +
              " title " + quoted(drawn_[series]->title);
    }
    return text + "\n";
  }

  const Plot& plot_;
  const Table& table_;
  std::string data_;
  bool is_bars_ = false;
  std::vector<const PlotSeries*> drawn_;  ///< that have a row
  std::vector<std::string> places_;       ///< of bars
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

PlotAxis node_axis() { return {.label = "nodes", .scale = PlotScale::powers_of_2}; }

PlotAxis percent_axis(const std::string& what) { return {.label = what + " (%)", .least = 0, .most = 105}; }

std::optional<std::string> script_of(const Plot& plot, const Table& table, const std::string& data_file) {
  return Script(plot, table, data_file).text();
}

}  // namespace dmpc::apps
