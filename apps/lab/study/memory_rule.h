// How much memory each node of a comparison has: a size, a share of the database, or what rays need.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dmpc::apps {

/// With neither set: what the better system with rays needs.
struct MemoryRule {
  std::optional<double> share = {};       ///< of the database, above 0 and at most 10
  std::optional<std::size_t> bytes = {};  ///< as --node-memory of `render`

  /// Returns the rule as on the command line: "rays", "25%", "1MiB".
  std::string text() const;
  /// Returns the memory of a node: all that it stores, for a database and what rays need, in bytes.
  std::size_t bytes_of(std::size_t database_bytes, std::size_t rays_bytes) const;
};

/// Parses "rays,25%,1MiB". Throws core::UsageError naming --node-memory for anything else.
std::vector<MemoryRule> parse_memory_rules(const std::string& text);

}  // namespace dmpc::apps
