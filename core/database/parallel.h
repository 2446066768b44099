// Work shared out among the cores, before and after the run; tracing has no threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace dmpc::core {

/// Threads that do the parts of a loop in any order, so that what a part does must not depend on the others. Under the thread
/// sanitizer, which does not understand oneTBB, one thread does all. Thread safety: for_each() may be called by a part.
class Parallel {
 public:
  /// `threads`: how many do the work; 0: one for each core.
  explicit Parallel(std::uint32_t threads);
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  /// How many parts are done at a time at most; at least 1.
  std::size_t threads() const;
  /// Calls part(i) once for each i below `count` and returns when all are done. Throws what a part throws, one of them if several
  /// do.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& part) const;
  /// Calls part(first, end) for runs of `together` numbers below `count`; the last may be shorter.
  void for_each_run(std::size_t count, std::size_t together, const std::function<void(std::size_t, std::size_t)>& part) const;
  /// Does as for_each(), and calls ended(i) after part(i); in any order, but never two of them at a time.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& part,
                const std::function<void(std::size_t)>& ended) const;

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;  ///< none: the calling thread alone
};

}  // namespace dmpc::core
