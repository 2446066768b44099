#include "apps/side_by_side.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

namespace dmpc::apps {

namespace {

using Finish = std::function<void()>;

/// A piece that takes long keeps so many others for each core from going on without it.
constexpr std::size_t pieces_per_core = 2;

}  // namespace

void side_by_side(std::size_t count, const std::function<Finish(std::size_t)>& work) {
  std::size_t next = 0;
  const auto deal = [&](tbb::flow_control& control) -> std::size_t {
    if (next == count) {
      control.stop();
      return count;
    }
    return next++;
  };
  const auto core_count = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(
      pieces_per_core * core_count,
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, deal) &
          tbb::make_filter<std::size_t, Finish>(tbb::filter_mode::parallel, work) &
          tbb::make_filter<Finish, void>(tbb::filter_mode::serial_in_order, [](const Finish& finish) { finish(); }));
}

}  // namespace dmpc::apps
