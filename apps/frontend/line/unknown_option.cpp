#include "apps/frontend/line/unknown_option.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "apps/frontend/line/small_letters.h"
#include "apps/frontend/line/text_table.h"

namespace dmpc::apps {

// Defined in sources that CMake generates from foreign_options.txt and gone_options.txt.
extern const char* const foreign_options_file;
extern const char* const gone_options_file;

namespace {

bool has(const std::vector<std::string_view>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "w", of "--w", "-w" and "-W640"; "+w", of "+W640"; names of several letters keep their digits.
std::string bare(const std::string& name) {
  const std::string word = in_small_letters(name.substr(std::min(name.find_first_not_of('-'), name.size())));
  const std::size_t letters = word.starts_with('+') ? 2 : 1;
  return word.find_first_not_of("0123456789", letters) == std::string::npos ? word.substr(0, letters) : word;
}

}  // namespace

std::optional<ForeignOption> foreign_option(const std::string& name) {
  const std::string word = bare(name);
  for (const auto& row : table_rows(foreign_options_file, 3)) {
    if (has(parts_between(row[0], " "), word)) {
      return ForeignOption{std::string(row[1]), std::string(row[2])};
    }
  }
  return std::nullopt;
}

std::string renamed_value(const std::string& option_and_value) { return option_and_value == "--quality=default" ? "good" : ""; }

std::string said_instead_of(const std::string& name) {
  for (const auto& row : table_rows(gone_options_file, 2)) {
    if (has(parts_between(row[0], ","), name)) {
      return std::string(row[1]);
    }
  }
  return "";
}

}  // namespace dmpc::apps
