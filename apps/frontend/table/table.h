// What a study finds: rows of figures under named columns, written as Markdown, CSV or JSON.
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

/// What stands in one place of a table: nothing, a text, a whole number, or a finite real one.
using Cell = std::variant<std::monostate, std::string, std::uint64_t, double>;

struct Column {
  std::string name;  ///< in words, unlike any other column's: "average load"
  std::string unit;  ///< "%", "bytes"; empty for mere numbers and texts
  int digits = 0;    ///< decimal places of real numbers in Markdown; the other formats have all there are
  /// For a first column of texts: in Markdown, rows with the same text form a table of their own below it.
  bool is_heading = false;
};

/// "average load (%)": how CSV and Markdown call it.
std::string header_of(const Column& column);

enum class TableFormat : std::uint8_t { markdown, csv, json, json_lines };

/// Every row has a cell for each column. Not thread-safe.
class Table {
 public:
  /// Requires columns whose names differ.
  Table(std::string title, std::vector<Column> columns);

  /// Expects as many cells as columns, and real numbers that are finite.
  void add_row(std::vector<Cell> row);
  /// `told` hears of the table after each row that is added from now on.
  void set_listener(std::function<void(const Table&)> reported) { reported_ = std::move(reported); }
  /// A sentence to stand under the table.
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

/// Letters in a line of a terminal, and of a page to be read.
inline constexpr std::size_t markdown_width_max = 120;

/// A row's cells as Markdown has them.
std::vector<std::string> texts_of(const Table& table, const std::vector<Cell>& row);

/// Nothing where it has none.
std::optional<double> number_of(const Cell& cell);
/// Where the column with this name stands. Expects one.
std::size_t number_of_column(const Table& table, std::string_view name);
/// The number in the column with this name; nothing where there is none, or the row has no number there.
std::optional<double> number_in(const Table& table, const std::vector<Cell>& row, std::string_view column);

/// The names and cells of a row, "nodes 4, virtual time (s) 3.142", as many as fit a line.
std::string row_text(const Table& table, const std::vector<Cell>& row);

/// A text as a cell of CSV: in quotes where it has to be (RFC 4180).
std::string csv_text(const std::string& text);

/// The whole table with a line end.
///   markdown   the title in bold, the table with its columns in line, the notes as a list, folded; a table that is wider than
///              markdown_width_max stands in pieces, each with the columns on the left that tell the rows apart; a heading in
///              bold, behind the column's name, and its rows below it
///   csv        a line of column names with their units, then a line a row as RFC 4180 quotes it; neither title nor notes
///   json       {"format", "title", "columns": [{"name", "unit"}], "rows": [{by name}], "notes": [...]}; names with underscores
///   for spaces,
///              units null where there are none
///   json_lines its rows alone, a line each
/// What is missing is empty, in JSON null.
std::string text_of(const Table& table, TableFormat format);

}  // namespace dmpc::apps
