#include "apps/lab/study/engine/study_line.h"

#include <algorithm>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "nodes/node_id.h"

namespace dmpc::apps {

void add_node_counts(OptionSet set, std::vector<std::uint32_t>& counts) {
  const std::string listed = joined(counts, ",", [&](const std::uint32_t count) { return std::to_string(count); });
  set.add_text(
      "--nodes", "N,N,... [" + listed + "]",
      [&counts](const std::string& text) { counts = parse_numbers(text, "--nodes", nodes::node_count_max); },
      "Nodes of the computers, one after the other");
}

const std::vector<Cell>* last_with(const Table& table, std::initializer_list<std::string_view> names) {
  const auto found = std::find_if(table.rows().rbegin(), table.rows().rend(), [&](const std::vector<Cell>& row) {
    return std::all_of(names.begin(), names.end(),
                       [&](std::string_view name) { return number_in(table, row, name).has_value(); });
  });
  return found == table.rows().rend() ? nullptr : &*found;
}

std::string nodes_text(const Table& table, const std::vector<Cell>& row) {
  return counted(static_cast<std::uint64_t>(number_in(table, row, "nodes").value_or(0)), "node");
}

}  // namespace dmpc::apps
