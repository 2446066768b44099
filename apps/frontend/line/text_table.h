// Tables that stand in text files: a row a line, with a mark between its cells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/expect.h"

namespace dmpc::apps {

/// The parts of a text between marks, without the blanks around them: at least one, which may be empty.
inline std::vector<std::string_view> parts_between(std::string_view text, std::string_view mark) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(mark, from), text.size());
    std::string_view part = text.substr(from, end - from);
    part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
    parts.push_back(part.substr(0, part.find_last_not_of(' ') + 1));
    from = end + mark.size();
  }
  return parts;
}

/// The rows of a table, as parts of its text. Empty lines and those that begin with # are none. Throws core::InternalError for a
/// row of more or fewer cells.
inline std::vector<std::vector<std::string_view>> table_rows(std::string_view text, std::size_t cell_count,
                                                             std::string_view mark = "|") {
  std::vector<std::vector<std::string_view>> rows;
  for (const std::string_view line : parts_between(text, "\n")) {
    if (!line.empty() && !line.starts_with('#')) {
      rows.push_back(parts_between(line, mark));
      core::expect(rows.back().size() == cell_count,
                   (std::to_string(cell_count) + " cells stand in a table's row: " + std::string(line)).c_str());
    }
  }
  return rows;
}

}  // namespace dmpc::apps
