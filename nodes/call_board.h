// The calls of programs in progress, for a watchdog that looks for one that does not return.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "nodes/atomics.h"
#include "nodes/node_id.h"

namespace dmpc::nodes {

/// Thread safety: begin() and end() belong to the thread that calls the node's program, look() to the watchdog.
class CallBoard {
 public:
  /// A call that has been in progress for this number of looks.
  struct Long {
    std::uint32_t node = 0;
    const char* what = "";  ///< "work()"
  };

  /// `looks`: how many times in succession the same call has to be seen.
  explicit CallBoard(std::uint32_t looks) : looks_(looks), slots_(std::make_unique<Slot[]>(node_count_max)) {}

  /// `what` is a literal. Requires that the node's last call has ended.
  void begin(std::uint32_t node, const char* what) {
    slots_[node].what.store(what, std::memory_order_relaxed);
    bump(slots_[node]);
  }
  void end(std::uint32_t node) { bump(slots_[node]); }

  /// The calls that have now been seen that many times, each once.
  std::vector<Long> look() {
    std::vector<Long> found;
    for (std::uint32_t node = 0; node < node_count_max; ++node) {
      Slot& slot = slots_[node];
      const std::uint32_t calls = slot.calls.load(std::memory_order_acquire);  // partner: bump()
      slot.looks = calls % 2 != 0 && calls == slot.seen ? slot.looks + 1 : 0;
      slot.seen = calls;
      if (slot.looks == looks_) {
        found.push_back({node, slot.what.load(std::memory_order_relaxed)});
      }
    }
    return found;
  }

 private:
  struct alignas(cache_line_bytes) Slot {
    std::atomic<std::uint32_t> calls{0};  ///< begun and ended: odd during a call
    std::atomic<const char*> what{""};
    std::uint32_t seen = 0, looks = 0;  ///< the watchdog's
  };

  static void bump(Slot& slot) {
    const std::uint32_t calls = slot.calls.load(std::memory_order_relaxed);
    slot.calls.store(calls + 1, std::memory_order_release);  // partner: look()
  }

  std::uint32_t looks_;
  std::unique_ptr<Slot[]> slots_;
};

}  // namespace dmpc::nodes
