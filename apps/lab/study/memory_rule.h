// How much of a scene a node may hold: what its system needs, a share of the database, or a bound in bytes.
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

/// Without either: as much as the system needs, and caches that hold the whole database.
struct MemoryRule {
  /// How much of the database, beside the node's own part, which is an Nth of it, a cache holds, or copies take. In (0, 1].
  std::optional<double> share = {};
  /// The bytes of all that the node's memory holds, as --node-memory of `render`.
  std::optional<std::size_t> bytes = {};

  /// As the command line has it: "auto", "25%", "1MiB".
  std::string text() const;
  /// Whether a system has another run by it than with as much memory as it needs.
  bool changes(System system) const { return bytes || (share && strategy_of(system).strategy == Strategy::svm); }
  /// Makes the memory of that many nodes follow the rule.
  void apply(StrategyOptions& options, const core::Database& database) const;
  /// Whether a node of `node_count` may hold so many bytes of the database: by `share`, in whole pages of which it may have one
  /// in any case.
  bool allows(std::size_t held_bytes, const core::Database& database, std::uint32_t node_count) const;
};

/// Bytes of the database that a memory holds: its own part, copies and what a cache has room for.
std::size_t held_bytes(const nodes::MemoryPlan& plan);

/// "auto,25%,1MiB". Throws core::UsageError naming --node-memory for anything else.
std::vector<MemoryRule> parse_memory_rules(const std::string& text);

}  // namespace dmpc::apps
