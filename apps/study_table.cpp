#include "apps/study_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "apps/figures.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

using Json = nlohmann::ordered_json;
using Line = std::vector<std::string>;

/// A text that cannot end its cell.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char character : text) {
    safe += character == '|' ? "\\|" : character == '\n' || character == '\r' ? " " : std::string(1, character);
  }
  return safe;
}

struct MarkdownCell {
  int digits;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return escaped(text); }
  std::string operator()(std::uint64_t number) const { return grouped(number); }
  std::string operator()(double number) const { return fixed(number, digits); }
};

/// How one column is laid out.
struct Layout {
  std::size_t width = 0;
  bool is_text = false;  ///< begins on the left
};

/// The header, then a line a row.
std::vector<Line> markdown_cells(const Table& table) {
  std::vector<Line> lines(1);
  for (const Column& column : table.columns()) {
    lines[0].push_back(escaped(header_of(column)));
  }
  for (const std::vector<Cell>& row : table.rows()) {
    Line& line = lines.emplace_back();
    for (std::size_t column = 0; column < row.size(); ++column) {
      line.push_back(std::visit(MarkdownCell{table.columns()[column].digits}, row[column]));
    }
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

std::string markdown_line(const Line& line, const std::vector<Layout>& layouts) {
  std::string text = "|";
  for (std::size_t column = 0; column < line.size(); ++column) {
    const std::string padding(layouts[column].width - line[column].size(), ' ');
    text += " " + (layouts[column].is_text ? line[column] + padding : padding + line[column]) + " |";
  }
  return text + "\n";
}

std::string markdown_rule(const std::vector<Layout>& layouts) {
  std::string text = "|";
  for (const Layout& layout : layouts) {
    text += std::string(layout.width + 1, '-') + (layout.is_text ? "-|" : ":|");
  }
  return text + "\n";
}

std::string markdown(const Table& table) {
  const std::vector<Line> lines = markdown_cells(table);
  const std::vector<Layout> layouts = layouts_of(table, lines);
  std::string text = "**" + table.title() + "**\n\n" + markdown_line(lines[0], layouts) + markdown_rule(layouts);
  for (std::size_t row = 1; row < lines.size(); ++row) {
    text += markdown_line(lines[row], layouts);
  }
  text += table.notes().empty() ? "" : "\n";
  for (const std::string& note : table.notes()) {
    text += "- " + note + "\n";
  }
  return text;
}

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char character : text) {
    quoted += character == '"' ? "\"\"" : std::string(1, character);
  }
  return quoted + "\"";
}

struct CsvCell {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return csv_text(text); }
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
  const Json all = {{"title", table.title()}, {"columns", columns}, {"rows", rows}, {"notes", table.notes()}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

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
}

std::string text_of(const Table& table, TableFormat format) {
  switch (format) {
    case TableFormat::csv:
      return csv(table);
    case TableFormat::json:
      return json(table);
    default:
      return markdown(table);
  }
}

}  // namespace dmpc::apps
