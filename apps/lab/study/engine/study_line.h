// Command line options and closing notes that all studies of one scene share.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/table/table.h"
#include "apps/scene/database_options.h"

namespace dmpc::apps {

/// The context in which a study declares its own options.
struct StudyLine {
  OptionSet set;
  std::string& machine_name;  ///< set to the typed text if a machine was typed: the table must not replace its file
  DatabaseOptions& database;  ///< of the scene
};

/// Declares --nodes: several numbers, whose defaults are in `counts`.
void add_node_counts(OptionSet set, std::vector<std::uint32_t>& counts);

/// Returns the last row that has a number in each of these columns; nullptr if there is none.
const std::vector<Cell>* last_with(const Table& table, std::initializer_list<std::string_view> names);
/// Returns "64 nodes", from the column `nodes`.
std::string nodes_text(const Table& table, const std::vector<Cell>& row);

}  // namespace dmpc::apps
