#include "apps/frontend/table/shown_rows.h"

#include <ostream>

#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/system/progress.h"

namespace dmpc::apps {

bool shows_rows(const TableOutput& output, bool quiet) {
  return !quiet && !output.file && output.format == TableFormat::markdown && stderr_is_terminal();
}

void ShownRows::show(const Table& table) {
  if (!is_shown_) {
    return;
  }
  for (const std::vector<Cell>& row : table.rows()) {
    std::vector<std::string> key = texts_of(table, row);
    key.push_back(table.title());
    if (shown_.insert(std::move(key)).second) {
      messages_ << clear_line << row_text(table, row) << std::endl;
    }
  }
}

}  // namespace dmpc::apps
