// A table's rows, shown one by one while the others are still awaited.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "apps/frontend/table/table_options.h"

namespace dmpc::apps {

/// Whether somebody waits at a terminal for a table to be read there.
bool shows_rows(const TableOutput& output, bool quiet);

/// Shows each row once. Not thread-safe.
class ShownRows {
 public:
  /// Says nothing at all unless `is_shown`. `messages` outlives it.
  ShownRows(bool is_shown, std::ostream& messages) : is_shown_(is_shown), messages_(messages) {}

  bool is_shown() const { return is_shown_; }

  /// Writes the table's rows that were not shown before, each as a line over the line of progress, which is written anew below
  /// it. Rows are the same that have the same texts in their first `key_count` cells.
  void show(const Table& table, std::size_t key_count = std::numeric_limits<std::size_t>::max());

 private:
  bool is_shown_;
  std::ostream& messages_;
  std::set<std::vector<std::string>> shown_;  ///< titles of tables, and keys
};

}  // namespace dmpc::apps
