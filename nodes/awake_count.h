// The number of awake nodes: zero means that all sleep and nothing is in flight, exactly and without a timeout.
//
// Thread safety: any thread may call anything, as far as the requirements of each function allow.
//
// Invariants
// (1) A node that runs is counted. So whoever calls raise() from a running node's thread finds a count of at least 1
//     and keeps it there.
// (2) A node leaves the count after its mailbox's word has become ASLEEP. Whoever replaces ASLEEP by a packet has
//     counted the sleeper again *before* (and takes the count back if another was faster). So every node that is
//     neither asleep nor about to be is counted, and a packet in a mailbox, whose receiver cannot be asleep, keeps
//     the count above zero.
// (3) Hence zero is reached once at most, and for ever: nobody is left to raise it. Unless there is one thread more, which
//     brings packets from other processes and is no node: it raises the count for itself before it puts them into mailboxes,
//     and leaves it after. Then zero lasts until that thread ends it, and it alone can know. (A node that brings some is
//     counted.)
#pragma once

#include <cstdint>

#include "nodes/atomics.h"

namespace dmpc::nodes {

template <class Atomics>
class BasicAwakeCount {
 public:
  /// All `count` nodes are awake.
  explicit BasicAwakeCount(std::uint32_t count) : count_(count) {}

  /// Counts a sleeper that the caller, a running node, is about to wake. Relaxed: the order against the woken node's own steps
  /// comes from the mailbox's word, which the caller replaces afterwards (release) and the woken node takes (acquire).
  void raise() { count_.fetch_add(1, std::memory_order_relaxed); }
  /// Takes a raise() back: another thread was faster. The caller is counted itself, so this never reaches zero.
  void withdraw() { count_.fetch_sub(1, std::memory_order_relaxed); }

  /// All `count` nodes are awake again, before another run; while none has a thread.
  void begin_again(std::uint32_t count) { count_.store(count, std::memory_order_relaxed); }

  /// For the thread that brings packets from elsewhere: whether all nodes sleep, and will until it wakes one. If so it may read
  /// what every node wrote.
  bool is_zero() const { return count_.load(std::memory_order_acquire) == 0; }

  /// The calling node's mailbox word is ASLEEP; leaves the count. True for the last one, which then may read what every other
  /// node wrote: the release of each node's leaving has its partner in the acquire of the last one's (all changes of the word are
  /// read-modify-writes, so each of them continues the release sequence).
  [[nodiscard]] bool leave() { return count_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

 private:
  alignas(cache_line_bytes) typename Atomics::template Atomic<std::uint32_t> count_;
};

using AwakeCount = BasicAwakeCount<SystemAtomics>;
static_assert(sizeof(AwakeCount) == cache_line_bytes, "the count shares its cache line with nothing");

}  // namespace dmpc::nodes
