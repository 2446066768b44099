// What the lock-free parts of the computer need from the real one: atomic words, sleep and wake, and notes of plain accesses.
#pragma once

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace dmpc::nodes {

/// Two threads that write different lines do not disturb each other.
inline constexpr std::size_t cache_line_bytes = 64;

/// The policy of real runs. Slot pool, mailbox and awake count are templates over such a policy, so that a test can replace it by
/// one that runs all interleavings. Thread safety: every function may be called from any thread.
struct SystemAtomics {
  template <class T>
  using Atomic = std::atomic<T>;
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free,
                "the progress guarantees need atomic words without a hidden lock");
  static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t), "a futex is a plain word of 32 bits");

  /// Blocks the calling thread while `word` is `value`, until wake() or for `most`; may also return spuriously, so check again.
  static void sleep(const Atomic<std::uint32_t>& word, std::uint32_t value, std::chrono::nanoseconds most) {
    const timespec time_out{.tv_sec = most.count() / 1'000'000'000, .tv_nsec = most.count() % 1'000'000'000};
    syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, value, &time_out, nullptr, 0);
  }
  /// Ends the sleep() of the one thread that sleeps on `word`, if there is one. Never blocks.
  static void wake(const Atomic<std::uint32_t>& word) { syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0); }

  /// Called before the plain bytes at `place` are read or written, for a policy that detects data races.
  static void reads(const void* /*place*/) {}
  static void writes(const void* /*place*/) {}
};

}  // namespace dmpc::nodes
