// What each table of the study `paper` comes to: a sentence, computed from its rows; empty if they tell too little.
#pragma once

#include <string>

#include "apps/edge/table/table.h"

namespace dmpc::apps {

/// `name` is that of the table's files: "table_3". Empty for a table that there is not.
std::string paper_conclusion(const std::string& name, const Table& table);

}  // namespace dmpc::apps
