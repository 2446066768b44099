// What studies of one scene have in common on the command line, and in their tables' last words.
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

/// Where a study declares the options that are its own.
struct StudyLine {
  OptionSet set;
  std::string& machine_name;  ///< becomes what was typed, if a machine was: the table must not replace its file
  DatabaseOptions& database;  ///< of the scene
};

/// Declares --nodes: several numbers, whose defaults are those there.
void add_node_counts(OptionSet set, std::vector<std::uint32_t>& counts);

/// The last row that has a number in each of these columns; nullptr if none has.
const std::vector<Cell>* last_with(const Table& table, std::initializer_list<std::string_view> names);
/// "64 nodes", by the column `nodes`.
std::string nodes_text(const Table& table, const std::vector<Cell>& row);

}  // namespace dmpc::apps
