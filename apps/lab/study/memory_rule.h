// How much of a scene a node may store: what its system needs, a share of the database, or a limit in bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/strategy_options.h"
#include "apps/run/systems.h"
#include "core/database/database.h"
#include "nodes/local_memory.h"

namespace dmpc::apps {

/// With neither set: as much as the system needs, and caches for the whole database.
struct MemoryRule {
  /// The share of the database that a cache or copies take, in addition to the node's own part, which is an Nth of it. In (0, 1].
  std::optional<double> share = {};
  /// The total bytes of the node's memory, as --node-memory of `render`.
  std::optional<std::size_t> bytes = {};

  /// Returns the rule as on the command line: "auto", "25%", "1MiB".
  std::string text() const;
  /// Returns whether the rule gives a system another run than unlimited memory does.
  bool changes(System system) const { return bytes || (share && strategy_of(system).strategy == Strategy::svm); }
  /// Applies the rule to the memory of that many nodes.
  void apply(StrategyOptions& options, const core::Database& database) const;
  /// Returns whether a node of `node_count` may store this many bytes of the database: by `share`, in whole pages, at least one.
  bool allows(std::size_t held_bytes, const core::Database& database, std::uint32_t node_count) const;
};

/// Returns the bytes of the database that fit a memory: the node's own part, copies and the cache.
std::size_t held_bytes(const nodes::MemoryPlan& plan);

/// Parses "auto,25%,1MiB". Throws core::UsageError naming --node-memory for anything else.
std::vector<MemoryRule> parse_memory_rules(const std::string& text);

}  // namespace dmpc::apps
