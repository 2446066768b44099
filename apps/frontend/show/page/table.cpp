#include "apps/frontend/show/page/table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/show/page/escaped.h"

namespace dmpc::apps::html {

namespace {

/// A table with more columns has less space for each.
constexpr std::size_t dense_columns = 11;

bool is_of_text(const Table& table, std::size_t column) {
  return std::any_of(table.rows().begin(), table.rows().end(),
                     [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

/// How the numbers of a column are shown.
struct ColumnStyle {
  ShownUnit unit;
  int digits = 0;
  bool is_rescaled = false;    ///< else each number as it is
  bool has_own_units = false;  ///< each cell names its unit
  bool is_text = false;
};

/// The largest number in all columns counted in the same unit.
double largest_in(const Table& table, const std::string& unit) {
  double largest = 0;
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    for (const std::vector<Cell>& row : table.rows()) {
      if (table.columns()[column].unit == unit) {
        largest = std::max(largest, number_of(row[column]).value_or(0));
      }
    }
  }
  return largest;
}

/// Whether a number of it would have fewer than two digits that tell something.
bool loses_numbers(const Table& table, std::size_t column, const ColumnStyle& style) {
  const double least_shown = std::pow(10.0, 1 - style.digits) * style.unit.size;
  return std::any_of(table.rows().begin(), table.rows().end(), [&](const auto& row) {
    const double value = number_of(row[column]).value_or(0);
    return value > 0 && value < least_shown;
  });
}

ColumnStyle style_of(const Table& table, std::size_t column) {
  const Column& described = table.columns()[column];
  const double largest = largest_in(table, described.unit);
  ColumnStyle style{.unit = shown_unit(described.unit, largest), .digits = described.digits};
  style.is_text = is_of_text(table, column);
  const bool is_smaller = style.unit.size < 1;  // numbers keep the unit that they are counted in, unless they grow too long in it
  style.is_rescaled = !is_smaller && (style.unit.size > 1 || style.unit.name != described.unit);
  if (style.is_rescaled && style.unit.size > 1) {
    style.digits = largest < 100 * style.unit.size ? 2 : largest < 1000 * style.unit.size ? 1 : 0;
    style.has_own_units = loses_numbers(table, column, style);
  }
  return style;
}

std::vector<ColumnStyle> styles_of(const Table& table) {
  std::vector<ColumnStyle> styles;
  for (std::size_t column = 0; column < table.columns().size(); ++column) {
    styles.push_back(style_of(table, column));
  }
  return styles;
}

std::string head_of(const Column& column, const ColumnStyle& style) {
  const std::string unit = style.has_own_units ? "" : style.is_rescaled ? style.unit.name : column.unit;
  std::string name = column.name;  // some are keys of JSON
  std::replace(name.begin(), name.end(), '_', ' ');
  return escaped(header_of({name, unit}));
}

std::string heads_of(const Table& table, const std::vector<ColumnStyle>& styles) {
  std::string heads;
  for (std::size_t i = 0; i < styles.size(); ++i) {
    heads += (styles[i].is_text ? "<th scope=\"col\" class=\"text\">" : "<th scope=\"col\">") +
             head_of(table.columns()[i], styles[i]) + "</th>";
  }
  return "<tr>" + heads + "</tr>\n";
}

std::string cell_text(const Cell& cell, const Column& column, const ColumnStyle& style) {
  if (const auto* const text = std::get_if<std::string>(&cell)) {
    return escaped_with_code(*text);
  }
  const std::optional<double> number = number_of(cell);
  if (!number) {
    return "";
  }
  if (style.has_own_units) {
    return amount_text(*number, column.unit);
  }
  if (style.is_rescaled) {
    return grouped(*number / style.unit.size, style.digits);
  }
  return std::holds_alternative<std::uint64_t>(cell) ? grouped(std::get<std::uint64_t>(cell)) : grouped(*number, style.digits);
}

/// Longer texts are broken into lines.
constexpr std::size_t long_text_bytes = 60;

std::string rows_of(const Table& table, const std::vector<ColumnStyle>& styles) {
  std::string text;
  for (const std::vector<Cell>& row : table.rows()) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* const words = std::get_if<std::string>(&row[i]);
      text += (words == nullptr                  ? std::string("<td>")
               : words->size() > long_text_bytes ? "<td class=\"text long\">"
                                                 : "<td class=\"text\">") +
              cell_text(row[i], table.columns()[i], styles[i]) + "</td>";
    }
    text += "</tr>\n";
  }
  return text;
}

/// "what-each-node-did"
std::string file_stem(const std::string& title) {
  constexpr std::size_t letters_max = 60;
  std::string stem;
  for (const char character : title.substr(0, letters_max)) {
    const auto letter = static_cast<unsigned char>(character);
    const bool is_plain = letter < 0x80 && std::isalnum(letter) != 0;
    if (is_plain || (!stem.empty() && stem.back() != '-')) {
      stem += is_plain ? static_cast<char>(std::tolower(letter)) : '-';
    }
  }
  return stem.substr(0, stem.find_last_not_of('-') + 1);
}

/// Saves under a name made of title and ending, which is the value of `attributes`' last.
std::string link_with(const std::string& attributes, const std::string& title, const std::string& ending) {
  return "<a class=\"save\" " + attributes + "=\"" + file_stem(title) + "." + in_small_letters(ending) + "\" title=\"Save as " +
         ending + ": " + escaped(title) + "\">" + ending + "</a>";
}

}  // namespace

std::string table_element(const Table& table, bool has_caption) {
  const std::vector<ColumnStyle> styles = styles_of(table);
  const bool is_dense = table.columns().size() > dense_columns;
  return (is_dense ? "<table class=\"dense\">\n" : "<table>\n") +
         std::string(has_caption ? "<caption>" + escaped(table.title()) + "</caption>\n" : "") + "<thead>" +
         heads_of(table, styles) + "</thead>\n<tbody>\n" + rows_of(table, styles) + "</tbody>\n</table>\n";
}

std::string words_of(const Table& table) {
  std::string words = table.title() + joined(table.columns(), "", [&](const Column& column) { return "\n" + column.name; });
  for (const std::vector<Cell>& row : table.rows()) {
    for (const Cell& cell : row) {
      if (const auto* const text = std::get_if<std::string>(&cell)) {
        words += "\n" + *text;
      }
    }
  }
  for (const std::string& note : table.notes()) {
    words += "\n" + note;
  }
  return words;
}

std::string save_link(const std::string& title, const std::string& ending, const std::string& url) {
  return link_with("href=\"" + url + "\" download", title, ending);
}

std::string shown_save_link(const std::string& title, const std::string& ending) {
  return link_with("hidden data-name", title, ending);
}

}  // namespace dmpc::apps::html
