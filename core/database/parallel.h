// Work distributed over the cores, before and after the run; tracing does not use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

namespace dmpc::core {

/// Threads that do the parts of a loop in any order, so parts must not depend on each other. Under the thread sanitizer, which
/// does not understand oneTBB, one thread does all. Thread safety: for_each() may be called by a part.
class Parallel {
 public:
  /// `threads`: number of threads; 0: one per core.
  explicit Parallel(std::uint32_t threads);
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  /// The maximum number of parts that run at a time; at least 1.
  std::size_t threads() const;
  /// Calls part(i) once for each i below `count` and returns when all are done. Rethrows the exception of a part, any one if
  /// there are several.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& part) const;
  /// Calls part(first, end) for runs of `together` numbers below `count`; the last may be shorter.
  void for_each_run(std::size_t count, std::size_t together, const std::function<void(std::size_t, std::size_t)>& part) const;
  /// As for_each(), but also calls ended(i) after part(i); in any order, but never two at a time.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& part,
                const std::function<void(std::size_t)>& ended) const;

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;  ///< empty: the calling thread alone
};

}  // namespace dmpc::core
