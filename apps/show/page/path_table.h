// The critical path of a run, with names for its parts.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/table/table.h"
#include "nodes/observer.h"

namespace dmpc::apps::html {

/// Returns a readable name: "page reply".
std::string packet_text(const std::string& kind_name);

/// Returns nanoseconds by name, without zeros; they add up to the path's.
std::vector<std::pair<std::string, std::uint64_t>> path_parts(const nodes::PathTimes& path);

/// Returns a table with a row for each part, and for messages also a row for each kind.
Table path_table(const nodes::PathTimes& path, std::span<const char* const> kind_names);
std::string path_conclusion(const nodes::PathTimes& path, std::span<const char* const> kind_names);

}  // namespace dmpc::apps::html
