#include "apps/lab/crowd/side_by_side.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <vector>

#include "core/base/usual_arithmetic.h"

namespace dmpc::apps {

namespace {

using Finish = std::function<void()>;

/// The number of pieces per core, so that a core does not wait for a long piece.
constexpr std::size_t pieces_per_core = 2;

}  // namespace

void side_by_side(std::size_t count, const std::function<Finish(std::size_t)>& work) {
  std::size_t next = 0;
  const auto assign = [&](tbb::flow_control& control) -> std::size_t {
    if (next == count) {
      control.stop();
      return count;
    }
    return next++;
  };
  const std::size_t most = pieces_per_core * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  // Pieces begin and end in order, so no two concurrent ones share a slot. The vector frees what is left when a piece throws;
  // oneTBB would leak it.
  std::vector<Finish> finishes(most);
  tbb::parallel_pipeline(most, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, assign) &
                                   tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel,
                                                                              [&](std::size_t piece) {
                                                                                core::use_usual_arithmetic();
                                                                                finishes[piece % most] = work(piece);
                                                                                return piece;
                                                                              }) &
                                   tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [&](std::size_t piece) {
                                     core::use_usual_arithmetic();
                                     std::exchange(finishes[piece % most], nullptr)();
                                   }));
  core::use_usual_arithmetic();  // oneTBB loads libraries on first use
}

}  // namespace dmpc::apps
