#include "dataflow/frames.h"

#include <doctest/doctest.h>

#include <optional>

#include "dataflow/packets.h"
#include "tests/support/walk.h"

namespace dataflow_frames_test {

using namespace dmpc;
using tests::Walk;

TEST_CASE("each frame has the film of a run of it alone where rays travel, on threads, a pool, in disorder and on a machine") {
  const Walk walk(24, {.page_size_bytes = 1024}, {0, 0.05, 0.1});
  for (const int way : {0, 1, 2, 3}) {
    dataflow::RunOptions options{.computer = {.node_count = 5}, .are_frames = true};
    options.computer.pool_threads = way == 1 ? std::optional(2U) : std::nullopt;
    options.computer.machine = way == 2 ? std::optional(nodes::Machine{}) : std::nullopt;
    options.computer.chaos = way == 3 ? std::optional(nodes::chaos_of(3)) : std::nullopt;
    const dataflow::Prepared prepared = dataflow::prepare(walk.database, walk.frames[0], options);
    dataflow::Frames frames(prepared, walk.frames[0], options, {});
    for (std::size_t i = 0; i < walk.frames.size(); ++i) {
      CAPTURE(way);
      CAPTURE(i);
      const dataflow::Report report = i == 0 ? frames.render({}) : frames.render(walk.frames[i], {}, {});
      const dataflow::Report alone = dataflow::run_dataflow(walk.database, walk.frames[i], {.computer = {.node_count = 3}}, {});
      CHECK(report.film.hash() == alone.film.hash());
      CHECK(report.operations().rays == alone.operations().rays);
    }
  }
}

TEST_CASE("the same frame again is the same travel, ray by ray: nodes keep nothing of it but their regions") {
  const Walk walk(24, {.page_size_bytes = 1024}, {0, 0.05, 0.1});
  const dataflow::RunOptions options{.computer = {.node_count = 4, .machine = nodes::Machine{}}, .are_frames = true};
  const dataflow::Prepared prepared = dataflow::prepare(walk.database, walk.frames[0], options);
  dataflow::Frames frames(prepared, walk.frames[0], options, {});
  const dataflow::Report first = frames.render({});
  const dataflow::Report again = frames.render(walk.frames[0], {}, {});
  CHECK(again.rays().out == first.rays().out);
  CHECK(again.ray_matrix() == first.ray_matrix());
  CHECK(again.gathers().rays == first.gathers().rays);
  CHECK(again.host_rays.film_entries > 0);
  CHECK(again.film.hash() == first.film.hash());
}

}  // namespace dataflow_frames_test
