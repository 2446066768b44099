// Shows a table's rows one by one while others are still computed.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "apps/frontend/table/table_options.h"

namespace dmpc::apps {

/// Returns whether a user waits at a terminal for a table that is printed there.
bool shows_rows(const TableOutput& output, bool quiet);

/// Shows each row once. Not thread-safe.
class ShownRows {
 public:
  /// Prints nothing unless `is_shown`. `messages` outlives it.
  ShownRows(bool is_shown, std::ostream& messages) : is_shown_(is_shown), messages_(messages) {}

  bool is_shown() const { return is_shown_; }

  /// Writes the table's new rows, each as a line above the progress line, which is rewritten below them. Rows count as the same
  /// if their cells have the same texts.
  void show(const Table& table);

 private:
  bool is_shown_;
  std::ostream& messages_;
  std::set<std::vector<std::string>> shown_;  ///< rows, each with its table's title
};

}  // namespace dmpc::apps
