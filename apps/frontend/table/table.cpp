#include "apps/frontend/table/table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/line/json_format.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;
using Line = std::vector<std::string>;

/// Letters of a row that is shown by itself; a terminal's line is at least this long.
constexpr std::size_t row_text_max = 79;

/// Escapes a text so that it cannot end its cell.
std::string escaped(const std::string& text) {
  return joined(text, "", [&](const char character) {
    return character == '|' ? "\\|" : character == '\n' || character == '\r' ? " " : std::string(1, character);
  });
}

struct MarkdownCell {
  int digits;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return escaped(text); }
  std::string operator()(std::uint64_t number) const { return grouped(number); }
  std::string operator()(double number) const { return fixed(number, digits); }
};

struct Layout {
  std::size_t width = 0;
  bool is_text = false;  ///< is left-aligned
};

/// Returns the header, then a line for each row.
std::vector<Line> markdown_cells(const Table& table) {
  std::vector<Line> lines(1);
  for (const Column& column : table.columns()) {
    lines[0].push_back(escaped(header_of(column)));
  }
  for (const std::vector<Cell>& row : table.rows()) {
    lines.push_back(texts_of(table, row));
  }
  return lines;
}

std::vector<Layout> layouts_of(const Table& table, const std::vector<Line>& lines) {
  std::vector<Layout> layouts(table.columns().size());
  for (std::size_t column = 0; column < layouts.size(); ++column) {
    Layout& layout = layouts[column];
    for (const Line& line : lines) {
      layout.width = std::max(layout.width, line[column].size());
    }
    layout.is_text = std::any_of(table.rows().begin(), table.rows().end(),
                                 [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
  }
  return layouts;
}

/// Indices of columns that stand side by side.
using Fold = std::vector<std::size_t>;

/// Returns the width of a cell with its bars and blanks.
std::size_t width_of(const Layout& layout) { return layout.width + 3; }

/// Returns this many columns from the left.
Fold first(std::size_t count) {
  Fold fold(count);
  std::iota(fold.begin(), fold.end(), std::size_t{0});
  return fold;
}

std::size_t width_of(const Fold& fold, const std::vector<Layout>& layouts) {
  return std::accumulate(fold.begin(), fold.end(), std::size_t{1},
                         [&](std::size_t sum, std::size_t column) { return sum + width_of(layouts[column]); });
}

bool is_wide(const std::vector<Layout>& layouts) { return width_of(first(layouts.size()), layouts) > markdown_width_max; }

/// Returns the fewest columns from the left by which all rows differ; all columns if none do.
std::size_t key_count(const std::vector<Line>& lines) {
  for (std::size_t count = 1; count < lines[0].size(); ++count) {
    std::set<Line> keys;
    for (const Line& line : lines) {
      keys.insert({line.begin(), line.begin() + static_cast<std::ptrdiff_t>(count)});
    }
    if (keys.size() == lines.size()) {
      return count;
    }
  }
  return lines[0].size();
}

/// Adds a first column with the numbers of the rows, to distinguish them.
void number_rows(std::vector<Line>& lines) {
  lines[0].insert(lines[0].begin(), "row");
  for (std::size_t row = 1; row < lines.size(); ++row) {
    lines[row].insert(lines[row].begin(), std::to_string(row));
  }
}

/// Returns whether the columns that distinguish the rows would fill most of each line.
bool has_wide_key(const std::vector<Line>& lines, const std::vector<Layout>& layouts) {
  return width_of(first(key_count(lines)), layouts) > markdown_width_max / 2;
}

/// Splits the columns into parts that fit a line, each beginning with the columns that distinguish its rows.
std::vector<Fold> folds_of(const std::vector<Line>& lines, const std::vector<Layout>& layouts) {
  if (!is_wide(layouts)) {
    return {first(layouts.size())};
  }
  const Fold key = first(key_count(lines));
  std::vector<Fold> folds = {key};
  for (std::size_t column = key.size(); column < layouts.size(); ++column) {
    if (folds.back().size() > key.size() && width_of(folds.back(), layouts) + width_of(layouts[column]) > markdown_width_max) {
      folds.push_back(key);
    }
    folds.back().push_back(column);
  }
  return folds;
}

std::string markdown_line(const Line& line, const std::vector<Layout>& layouts, const Fold& fold) {
  std::string text = "|";
  for (const std::size_t column : fold) {
    const std::string padding(layouts[column].width - line[column].size(), ' ');
    text += " " + (layouts[column].is_text ? line[column] + padding : padding + line[column]) + " |";
  }
  return text + "\n";
}

std::string markdown_rule(const std::vector<Layout>& layouts, const Fold& fold) {
  const std::string text = "|" + joined(fold, "", [&](const std::size_t column) {
                             return std::string(layouts[column].width + 1, '-') + (layouts[column].is_text ? "-|" : ":|");
                           });
  return text + "\n";
}

/// Returns the rows in parts that fit a line.
std::string markdown_rows(const Table& table) {
  std::vector<Line> lines = markdown_cells(table);
  std::vector<Layout> layouts = layouts_of(table, lines);
  if (is_wide(layouts) && has_wide_key(lines, layouts)) {
    number_rows(lines);
    std::vector<Layout> numbered(1, Layout{std::max(lines.front().front().size(), lines.back().front().size()), false});
    numbered.insert(numbered.end(), layouts.begin(), layouts.end());
    layouts = std::move(numbered);
  }
  std::string text;
  for (const Fold& fold : folds_of(lines, layouts)) {
    text += "\n" + markdown_line(lines[0], layouts, fold) + markdown_rule(layouts, fold);
    for (std::size_t row = 1; row < lines.size(); ++row) {
      text += markdown_line(lines[row], layouts, fold);
    }
  }
  return text;
}

std::string markdown(const Table& table) {
  std::string text = folded("**" + table.title() + "**", markdown_width_max, "  ") + "\n" + markdown_rows(table);
  text += table.notes().empty() ? "" : "\n";
  for (const std::string& note : table.notes()) {
    text += folded("- " + note, markdown_width_max, "  ") + "\n";
  }
  return text;
}

/// Spreadsheets would run a name from a file as a formula if it begins like one: an apostrophe makes it a text. A sign alone, or
/// before a digit, is none.
std::string as_text(const std::string& text) {
  const bool is_sign = !text.empty() && (text[0] == '+' || text[0] == '-');
  const bool is_harmless = is_sign && (text.size() == 1 || text.find_first_not_of("0123456789.,eE+-%") == std::string::npos);
  const bool begins_formula =
      is_sign ? !is_harmless : !text.empty() && std::string_view("=@\t\r").find(text[0]) != std::string_view::npos;
  return begins_formula ? "'" + text : text;
}

struct CsvCell {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return csv_text(as_text(text)); }
  std::string operator()(std::uint64_t number) const { return std::to_string(number); }
  std::string operator()(double number) const { return shortest(number); }
};

template <class Items, class Text>
std::string csv_line(const Items& items, const Text& text_of_item) {
  std::string line;
  for (const auto& item : items) {
    line += (&item == &items.front() ? "" : ",") + text_of_item(item);
  }
  return line + "\n";
}

std::string csv(const Table& table) {
  std::string text = csv_line(table.columns(), [](const Column& column) { return csv_text(header_of(column)); });
  for (const std::vector<Cell>& row : table.rows()) {
    text += csv_line(row, [](const Cell& cell) { return std::visit(CsvCell{}, cell); });
  }
  return text;
}

/// Returns the number of columns if none has the name.
std::size_t place_of(const Table& table, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(table.columns(), name, &Column::name) - table.columns().begin());
}

std::string key_of(const Column& column) {
  std::string key = column.name;
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

struct JsonCell {
  Json operator()(std::monostate) const { return nullptr; }
  template <class Value>
  Json operator()(const Value& value) const {
    return value;
  }
};

Json json_row(const Table& table, const std::vector<Cell>& row) {
  Json object = Json::object();
  for (std::size_t column = 0; column < row.size(); ++column) {
    object[key_of(table.columns()[column])] = std::visit(JsonCell{}, row[column]);
  }
  return object;
}

std::string json(const Table& table) {
  Json columns = Json::array(), rows = Json::array();
  for (const Column& column : table.columns()) {
    columns.push_back({{"name", key_of(column)}, {"unit", column.unit.empty() ? Json(nullptr) : Json(column.unit)}});
  }
  for (const std::vector<Cell>& row : table.rows()) {
    rows.push_back(json_row(table, row));
  }
  const Json all = {
      {"format", json_format}, {"title", table.title()}, {"columns", columns}, {"rows", rows}, {"notes", table.notes()}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string json_lines(const Table& table) {
  return joined(table.rows(), "", [&](const std::vector<Cell>& row) {
    return json_row(table, row).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  });
}

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  const std::string quoted =
      "\"" + joined(text, "", [&](const char character) { return character == '"' ? "\"\"" : std::string(1, character); });
  return quoted + "\"";
}

std::string header_of(const Column& column) { return column.unit.empty() ? column.name : column.name + " (" + column.unit + ")"; }

Table::Table(std::string title, std::vector<Column> columns) : title_(std::move(title)), columns_(std::move(columns)) {
  std::set<std::string_view> names;
  for (const Column& column : columns_) {
    core::expect(names.insert(column.name).second, "the columns of a table have names of their own");
  }
}

void Table::add_row(std::vector<Cell> row) {
  core::expect(row.size() == columns_.size(), "a row has a cell for each column");
  for (const Cell& cell : row) {
    const double* const number = std::get_if<double>(&cell);
    core::expect(number == nullptr || std::isfinite(*number), "a table's numbers are finite");
  }
  rows_.push_back(std::move(row));
  if (reported_) {
    reported_(*this);
  }
}

std::vector<std::string> texts_of(const Table& table, const std::vector<Cell>& row) {
  std::vector<std::string> texts;
  for (std::size_t column = 0; column < row.size(); ++column) {
    texts.push_back(std::visit(MarkdownCell{table.columns()[column].digits}, row[column]));
  }
  return texts;
}

std::optional<double> number_of(const Cell& cell) {
  if (const auto* const whole = std::get_if<std::uint64_t>(&cell)) {
    return static_cast<double>(*whole);
  }
  const auto* const real = std::get_if<double>(&cell);
  return real == nullptr ? std::nullopt : std::optional(*real);
}

std::size_t number_of_column(const Table& table, std::string_view name) {
  const std::size_t number = place_of(table, name);
  core::expect(number < table.columns().size(), "a column that is asked for is one that the table has");
  return number;
}

std::optional<double> number_in(const Table& table, const std::vector<Cell>& row, std::string_view column) {
  const std::size_t number = place_of(table, column);
  return number < row.size() ? number_of(row[number]) : std::nullopt;
}

std::string row_text(const Table& table, const std::vector<Cell>& row) {
  const std::vector<std::string> cells = texts_of(table, row);
  std::string text;
  for (std::size_t column = 0; column < cells.size(); ++column) {
    const std::string more = (text.empty() ? "" : ", ") + header_of(table.columns()[column]) + " " + cells[column];
    if (!cells[column].empty() && text.size() + more.size() <= row_text_max) {
      text += more;
    }
  }
  return text;
}

std::string text_of(const Table& table, TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return csv(table);
    case TableFormat::json:
      return json(table);
    case TableFormat::json_lines:
      return json_lines(table);
    default:
      return markdown(table);
  }
}

}  // namespace dmpc::apps
