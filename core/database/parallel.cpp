#include "core/database/parallel.h"

#include <algorithm>
#include <mutex>

#include "core/base/units.h"

#ifndef DMPC_SERIAL_BUILD
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/base/usual_arithmetic.h"
#endif

namespace dmpc::core {

#ifdef DMPC_SERIAL_BUILD

struct Parallel::Arena {
  static std::unique_ptr<Arena> of(std::uint32_t) { return nullptr; }
  void for_each(std::size_t, const std::function<void(std::size_t)>&) {}
  std::size_t concurrency() const { return 1; }
};

#else

struct Parallel::Arena {
  /// Returns nullptr for one thread.
  static std::unique_ptr<Arena> of(std::uint32_t threads) {
    const int concurrency = threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
    return threads == 1 ? nullptr : std::make_unique<Arena>(concurrency);
  }
  explicit Arena(int concurrency) : threads(concurrency) {}

  /// At its first use oneTBB starts threads and loads libraries; to be asked for its concurrency is a use.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& part) {
    threads.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&part](std::size_t i) {
        use_usual_arithmetic();
        part(i);
      });
    });
    use_usual_arithmetic();
  }
  std::size_t concurrency() const {
    const int count = threads.max_concurrency();
    use_usual_arithmetic();
    return static_cast<std::size_t>(count);
  }

  tbb::task_arena threads;
};

#endif

Parallel::Parallel(std::uint32_t threads) : arena_(Arena::of(threads)) {}
Parallel::~Parallel() = default;

std::size_t Parallel::threads() const { return arena_ == nullptr ? 1 : arena_->concurrency(); }

void Parallel::for_each(std::size_t count, const std::function<void(std::size_t)>& part) const {
  if (arena_ != nullptr && count > 1) {
    return arena_->for_each(count, part);
  }
  for (std::size_t i = 0; i < count; ++i) {
    part(i);
  }
}

void Parallel::for_each_run(std::size_t count, std::size_t together,
                            const std::function<void(std::size_t, std::size_t)>& part) const {
  for_each(ceil_divide(count, together), [&](std::size_t run) { part(run * together, std::min(count, (run + 1) * together)); });
}

void Parallel::for_each(std::size_t count, const std::function<void(std::size_t)>& part,
                        const std::function<void(std::size_t)>& ended) const {
  std::mutex one_at_a_time;
  for_each(count, [&](std::size_t i) {
    part(i);
    const std::lock_guard lock(one_at_a_time);
    ended(i);
  });
}

}  // namespace dmpc::core
