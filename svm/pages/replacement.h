// The replacement policies that there are, by name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "nodes/local_memory.h"
#include "svm/pages/policy/policy.h"

namespace dmpc::svm {

/// A policy: one of these, or what add_policy() returned.
enum class Replacement : std::uint8_t { lru, clock, fifo, random, two_queues, adaptive, small_and_main };

/// What is known of a policy before there is a cache.
struct PolicyKind {
  std::string_view name;     ///< as the command line has it; lasts as long as the program
  std::string_view meaning;  ///< which page makes room, in some words; likewise
  bool hears_hits = false;   ///< without this the time stamps tell it all that it wants to know, and hits cost nothing more
  /// What make() takes for a cache of so many frames, none included.
  nodes::MemoryPlan (*layout)(std::uint32_t frame_count) = nullptr;
  std::unique_ptr<ReplacementPolicy> (*make)(const PolicySite& site) = nullptr;
};

/// Adds a policy of one's own to those of --replacement. To be called before any other thread is there, and at most 249 times.
/// The name is not another's.
Replacement add_policy(const PolicyKind& kind);

/// In the order of their numbers; until the next add_policy().
std::span<const PolicyKind> policy_kinds();
const PolicyKind& kind_of(Replacement replacement);
inline std::string_view name_of(Replacement replacement) { return kind_of(replacement).name; }

}  // namespace dmpc::svm
