// Tables that stand in text files beside the tests which walk them.
#pragma once

#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/line/text_table.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// `text` in which \n is the end of a line.
inline std::string with_line_ends(std::string text) {
  for (std::size_t at = 0; (at = text.find("\\n", at)) != std::string::npos; ++at) {
    text.replace(at, 2, "\n");
  }
  return text;
}

/// The rows, one at least, of a file of tests/, with => between cells, in which \n is the end of a line. Of a file in sections
/// only those below the line "## section".
inline std::vector<std::vector<std::string>> rows_in(const std::string& file, std::size_t cell_count,
                                                     const std::string& section = "") {
  std::string text = file_text(std::string(DMPC_SOURCE_DIR "/tests/") + file);
  if (!section.empty()) {
    const std::size_t begin = text.find("\n## " + section + "\n");
    core::expect(begin != std::string::npos, "a table has the section that a test walks");
    text = text.substr(begin + 1, text.find("\n## ", begin + 1) - begin);
  }
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : apps::table_rows(text, cell_count, "=>")) {
    rows.emplace_back();
    for (const std::string_view cell : row) {
      rows.back().push_back(with_line_ends(std::string(cell)));
    }
  }
  core::expect(!rows.empty(), "a table has rows");
  return rows;
}

/// What is given, and words of what is said of it.
inline std::vector<Complaint> complaints_in(const std::string& file, const std::string& section = "") {
  std::vector<Complaint> complaints;
  for (const auto& row : rows_in(file, 2, section)) {
    complaints.push_back({row[0], row[1]});
  }
  return complaints;
}

/// Numbers with blanks between.
inline std::vector<double> numbers_of(const std::string& cell) {
  std::istringstream stream(cell);
  return {std::istream_iterator<double>(stream), std::istream_iterator<double>()};
}

}  // namespace dmpc::tests
