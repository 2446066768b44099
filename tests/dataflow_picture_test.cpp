// One picture with dataflow: whatever the nodes, the bounds and the schedule, the film equals the reference renderer's to the
// last bit.
#include <doctest/doctest.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/database.h"
#include "core/render.h"
#include "dataflow/run.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests {

namespace {

using dataflow::RunOptions;

/// A scene, its database, and its picture by the reference renderer.
class Subject {
 public:
  Subject(const core::Scene& scene, int side, int samples = 1)
      : database_(core::build_database(scene, {})),
        settings_{database_.header(), core::Camera(scene.view, database_.header().frame, side, side, samples), {}} {
    core::LocalRecords records(database_.bytes());
    core::GridTracer tracer(records, settings_.header, core::TraversalOptions{});
    hash_ = core::render(tracer, settings_, operations_).hash();
  }

  dataflow::Report run(const RunOptions& options) const { return dataflow::run_dataflow(database_, settings_, options, {}); }

  /// Runs and holds picture, rays and hits to the reference renderer's.
  dataflow::Report check(const RunOptions& options) const {
    CAPTURE(options.node_count);
    dataflow::Report report = run(options);
    const core::Operations operations = report.operations();
    CHECK(report.film.hash() == hash_);
    CHECK(operations.rays == operations_.rays);
    CHECK(operations.primary_hits == operations_.primary_hits);
    CHECK(operations.secondary_hits == operations_.secondary_hits);
    CHECK(operations.shadow_blocked == operations_.shadow_blocked);
    CHECK(operations.shadings == operations_.shadings);
    return report;
  }

 private:
  core::Database database_;
  core::RenderSettings settings_;
  core::Operations operations_;
  std::uint64_t hash_ = 0;
};

}  // namespace

TEST_CASE("dataflow: any number of nodes gives the reference renderer's picture") {
  const Subject subject(mirrors_and_glass(), 24);
  for (const std::uint32_t nodes : {1U, 2U, 3U, 5U, 8U, 16U, 64U}) {
    subject.check({.node_count = nodes});
  }
}

}  // namespace dmpc::tests
