// The critical path of a run, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/table/table.h"
#include "nodes/observer.h"

namespace dmpc::apps::html {

/// As people read it: "page reply".
std::string packet_text(const std::string& kind_name);

/// Nanoseconds by name, those of which there are any; they add up to the path's.
std::vector<std::pair<std::string, std::uint64_t>> path_parts(const nodes::PathTimes& path);

/// A row for each part, and for messages one for each of their kinds, too.
Table path_table(const nodes::PathTimes& path, std::span<const char* const> kind_names);
/// In a sentence.
std::string path_conclusion(const nodes::PathTimes& path, std::span<const char* const> kind_names);

}  // namespace dmpc::apps::html
