// A table of results: rows under named columns, written as Markdown, CSV or JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace dmpc::apps {

/// A cell's value: nothing, a text, an integer, or a finite real number.
using Cell = std::variant<std::monostate, std::string, std::uint64_t, double>;

struct Column {
  std::string name;  ///< in words, unique within the table: "average load"
  std::string unit;  ///< "%", "bytes"; empty for dimensionless numbers and texts
  int digits = 0;    ///< decimal places of real numbers in Markdown; the other formats have all digits
};

/// Returns the heading in CSV and Markdown: "average load (%)".
std::string header_of(const Column& column);

enum class TableFormat : std::uint8_t { markdown, csv, json, json_lines };

/// Every row has a cell for each column. Not thread-safe.
class Table {
 public:
  /// Requires distinct column names.
  Table(std::string title, std::vector<Column> columns);

  /// Requires as many cells as columns, and finite real numbers.
  void add_row(std::vector<Cell> row);
  /// `reported` is called with the table after each row that is added from now on.
  void set_listener(std::function<void(const Table&)> reported) { reported_ = std::move(reported); }
  /// Adds a sentence below the table.
  void add_note(std::string note) { notes_.push_back(std::move(note)); }

  const std::string& title() const { return title_; }
  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<std::vector<Cell>>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::string title_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;
  std::vector<std::string> notes_;
  std::function<void(const Table&)> reported_;
};

/// Line width in letters for a terminal and for a page.
inline constexpr std::size_t markdown_width_max = 120;

/// Returns a row's cells in Markdown.
std::vector<std::string> texts_of(const Table& table, const std::vector<Cell>& row);

/// Returns nothing if the cell is not a number.
std::optional<double> number_of(const Cell& cell);
/// Returns the index of the column with this name. Requires that it exists.
std::size_t number_of_column(const Table& table, std::string_view name);
/// Returns the number in the column with this name; nothing if there is no such column, or the cell has no number.
std::optional<double> number_in(const Table& table, const std::vector<Cell>& row, std::string_view column);

/// Returns names and cells of a row, "nodes 4, virtual time (s) 3.142", as many as fit on a line.
std::string row_text(const Table& table, const std::vector<Cell>& row);

/// Quotes a text for CSV where needed (RFC 4180).
std::string csv_text(const std::string& text);

/// Returns the whole table with a line end. An absent value is empty; in JSON it is null.
/// - markdown: the title in bold, the table with aligned columns, and the notes as a folded list. A table wider than
///   markdown_width_max is split into parts, each of which repeats the left columns that distinguish the rows. A heading follows
///   the column's name in bold, and its rows stand below it.
/// - csv: a line of column names with their units, then a line for each row with RFC 4180 quoting; neither title nor notes.
/// - json: {"format", "title", "columns": [{"name", "unit"}], "rows": [{by name}], "notes": [...]}; names with underscores for
///   spaces, and null for a missing unit.
/// - json_lines: the rows alone, a line each.
std::string text_of(const Table& table, TableFormat format);

}  // namespace dmpc::apps
