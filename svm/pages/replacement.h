// What a replacement policy is told, and what it is asked; and those that there are, by name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "nodes/local_memory.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// The time of each frame's last reference, always above 0. A policy may set one to 0: not referenced since.
using Stamps = std::span<std::uint64_t>;

/// Where a policy is to work.
struct PolicySite {
  nodes::LocalMemory& memory;     ///< of its node: all that grows with the number of frames lies there
  Stamps stamps;                  ///< of the cache's frames, written by the cache at each reference
  std::span<const PageId> pages;  ///< in the frames that are filled
  std::uint32_t seed = 0;         ///< the node's own number

  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps.size()); }
};

/// Decides which page leaves a full cache when another one arrives. Frames are filled in their order, and no page leaves before
/// all are. What it decides depends on what it was told, and on its seed, alone. Thread safety: none; belongs to one node.
class ReplacementPolicy {
 public:
  virtual ~ReplacementPolicy() = default;
  /// A page in a frame is referenced; only if PolicyKind::hears_hits. References of one page in a row count as one, those of
  /// pages at home left out; the first of a page that came is its insert().
  virtual void hit(PageId /*page*/, std::uint32_t /*frame*/) {}
  /// A page has come into a frame that was empty or is victim()'s.
  virtual void insert(PageId /*page*/, std::uint32_t /*frame*/) {}
  /// The frame whose page leaves now for `incoming`, which insert() names next. Every frame has a page, and there is one.
  virtual std::uint32_t victim(PageId incoming) = 0;
};

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
