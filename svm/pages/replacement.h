// The interface of replacement policies, and the list of them, by name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "nodes/local_memory.h"
#include "svm/pages/page.h"

namespace dmpc::svm {

/// The time of each frame's last reference, always above 0. A policy may set one to 0: not referenced since.
using Stamps = std::span<std::uint64_t>;

/// The environment of a policy.
struct PolicySite {
  nodes::LocalMemory& memory;     ///< the node's: everything that grows with the number of frames lies there
  Stamps stamps;                  ///< the cache's frames', written by the cache at each reference
  std::span<const PageId> pages;  ///< pages of the filled frames
  std::uint32_t seed = 0;         ///< the node's number

  std::uint32_t frame_count() const { return static_cast<std::uint32_t>(stamps.size()); }
};

/// What victim() returns in place of a frame if the incoming page is not cached: insert() is then not called. Only policies of
/// the user's do so.
inline constexpr std::uint32_t bypass = 0xffffffffU;

/// Decides which page is evicted from a full cache when another one arrives. Frames are filled in order, and no page is evicted
/// before all are full. Decisions depend only on the calls and the seed. Not thread-safe; belongs to one node.
class ReplacementPolicy {
 public:
  virtual ~ReplacementPolicy() = default;
  /// A page in a frame is referenced; only if PolicyKind::hears_hits. Consecutive references of one page count as one, not
  /// counting pages at home; the first one after a page's arrival is its insert().
  virtual void hit(PageId /*page*/, std::uint32_t /*frame*/) {}
  /// A page has arrived in a frame that was empty or is victim()'s.
  virtual void insert(PageId /*page*/, std::uint32_t /*frame*/) {}
  /// The frame whose page is evicted for `incoming`, the next insert(), or bypass. Every frame has a page, and there is at least
  /// one.
  virtual std::uint32_t victim(PageId incoming) = 0;
};

/// A policy, by the number of its row in policy_kinds().
enum class Replacement : std::uint8_t { lru, clock, fifo, random, two_queues, adaptive, small_and_main };

/// The description of a policy.
struct PolicyKind {
  std::string_view name;     ///< option's value; lives as long as the program
  std::string_view meaning;  ///< which page is evicted, in some words; likewise
  bool hears_hits = false;   ///< otherwise the policy reads only time stamps, and hits cost nothing more
  /// The memory that make() takes for a cache of `frame_count` frames, possibly 0.
  nodes::MemoryPlan (*layout)(std::uint32_t frame_count) = nullptr;
  std::unique_ptr<ReplacementPolicy> (*make)(const PolicySite& site) = nullptr;
};

/// In the order of their numbers.
std::span<const PolicyKind> policy_kinds();
const PolicyKind& kind_of(Replacement replacement);
inline std::string_view name_of(Replacement replacement) { return kind_of(replacement).name; }

/// The caches of one run under a policy of the user's. Hears all hits. Not thread-safe.
class OwnPolicyRun {
 public:
  virtual ~OwnPolicyRun() = default;
  /// The policy of one node's cache, with at least one frame; this outlives it.
  virtual std::unique_ptr<ReplacementPolicy> make(const PolicySite& site) = 0;
  /// To be called when the picture is done: throws what has gone wrong unseen.
  virtual void finish() = 0;
};

/// A policy that is none of policy_kinds(), on modelled machines only. An immutable value.
class OwnPolicy {
 public:
  virtual ~OwnPolicy() = default;
  virtual const std::string& name() const = 0;
  virtual std::unique_ptr<OwnPolicyRun> start() const = 0;
};

}  // namespace dmpc::svm
