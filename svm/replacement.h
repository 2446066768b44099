// Which page leaves a full cache when another one arrives.
//
// Whatever the policy, the cache writes a time stamp for each reference, so a page hit costs the same store under all of them;
// they differ in what they read from the stamps, and in memory of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "nodes/local_memory.h"

namespace dmpc::svm {

/// lru: the page that was referenced least recently, exactly. clock: the first, going round, that was not referenced since the
/// last time round. fifo: the page that came first. random: any, with equal chances.
enum class Replacement : std::uint8_t { lru, clock, fifo, random };

/// "lru", "clock", "fifo" or "random".
std::string_view name_of(Replacement replacement);

/// The time of each frame's last reference, always above 0. A policy may set one to 0: not referenced since.
using Stamps = std::span<std::uint64_t>;

/// Exact. A search yields the oldest few at once, in order: as long as their stamps have not changed they are the frames with
/// the least stamps of all, for stamps only grow, so a frame that was not among the oldest cannot become older than one that was.
class LeastRecentlyUsed {
 public:
  LeastRecentlyUsed(nodes::LocalMemory& memory, std::uint32_t frame_count);
  static void add_needs(nodes::MemoryPlan& plan, std::uint32_t frame_count);
  std::uint32_t victim(Stamps stamps);

 private:
  struct Candidate {
    std::uint64_t stamp = 0;
    std::uint32_t frame = 0;
    std::uint32_t padding = 0;
  };
  static std::size_t candidate_capacity(std::uint32_t frame_count);
  void seek_candidates(Stamps stamps);

  std::span<Candidate> candidates_;  ///< the oldest frames at the last search, oldest first
  std::size_t candidate_count_ = 0, next_candidate_ = 0;
};

/// A hand goes round the frames and takes the mark of a reference from each that has one, until it finds one without (F. J.
/// Corbato, "A Paging Experiment with the Multics System", 1968). A page that has just come has a mark. No memory of its own.
class Clock {
 public:
  std::uint32_t victim(Stamps stamps);

 private:
  std::uint32_t hand_ = 0;
};

/// Frames are filled in their order, so the page that came first is always the next one round. No memory of its own.
class FirstInFirstOut {
 public:
  std::uint32_t victim(Stamps stamps);

 private:
  std::uint32_t next_ = 0;
};

/// Draws from a sequence that depends on the seed alone. With n frames the chances differ from 1/n by less than 2^-32. No memory
/// of its own.
class RandomVictim {
 public:
  explicit RandomVictim(std::uint32_t seed);
  std::uint32_t victim(Stamps stamps);

 private:
  std::uint64_t state_;
};

/// One of the policies. Thread safety: none; belongs to one node.
class VictimChoice {
 public:
  /// `seed` is the node's own number; only random reads it.
  VictimChoice(nodes::LocalMemory& memory, Replacement replacement, std::uint32_t frame_count, std::uint32_t seed);
  /// Adds to `plan` exactly what the constructor takes.
  static void add_needs(nodes::MemoryPlan& plan, Replacement replacement, std::uint32_t frame_count);

  /// The frame whose page leaves now. Requires that every frame has a page, one at least, and that victims are replaced at once.
  std::uint32_t victim(Stamps stamps) {
    return std::visit([stamps](auto& policy) { return policy.victim(stamps); }, policy_);
  }

 private:
  using Policy = std::variant<LeastRecentlyUsed, Clock, FirstInFirstOut, RandomVictim>;
  static Policy make(nodes::LocalMemory& memory, Replacement replacement, std::uint32_t frame_count, std::uint32_t seed);

  Policy policy_;
};

}  // namespace dmpc::svm
