#include "apps/foreign/pbrt/parameter_table.h"

#include <algorithm>
#include <vector>

#include "apps/frontend/line/text_table.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
extern const char* const pbrt_parameters_file;  // defined in a source that CMake generates from parameters.txt
}

namespace dmpc::apps::pbrt {
namespace {

/// Returns the position of the letter, or the text's length without it.
std::size_t place_of(char letter, std::string_view text) {
  std::size_t at = 0;
  while (at < text.size() && text[at] != letter) {
    ++at;
  }
  return at;
}

/// Returns nullptr if there is no such row.
const ParameterRow* find_row(std::string_view statement, std::string_view kind) {
  const auto is_it = [&](const ParameterRow& row) { return row.statement == statement && row.kind == kind; };
  const std::span<const ParameterRow> table = parameter_table();
  return core::find_in(table, true, is_it);
}

bool has(std::string_view list, std::string_view name) {
  while (!list.empty()) {
    if (next_of(list).name == name) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::span<const ParameterRow> parameter_table() {
  static const auto table = core::mapped<ParameterRow>(table_rows(pbrt_parameters_file, 5), [](const auto& row) {
    return ParameterRow{row[0], row[1], row[2], row[3], row[4]};
  });
  return table;
}

ListedParameter next_of(std::string_view& list) {
  const std::size_t end = place_of(',', list);
  const std::string_view both = list.substr(0, end);
  list.remove_prefix(std::min(end + 2, list.size()));
  const std::size_t blank = place_of(' ', both);
  return {both.substr(0, blank), both.substr(std::min(blank + 1, both.size()))};
}

bool has_row(std::string_view statement, std::string_view kind) { return find_row(statement, kind) != nullptr; }

ParameterFate fate_of(std::string_view statement, std::string_view kind, std::string_view name) {
  const ParameterRow* const row = find_row(statement, kind);
  if (row == nullptr) {
    return ParameterFate::unknown;
  }
  return has(row->used, name)     ? ParameterFate::used
         : has(row->said, name)   ? ParameterFate::said
         : has(row->silent, name) ? ParameterFate::silent
                                  : ParameterFate::unknown;
}

}  // namespace dmpc::apps::pbrt
