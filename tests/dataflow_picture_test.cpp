// One picture with dataflow: whatever the nodes, the regions, the bounds and the schedule, the film equals the reference
// renderer's to the last bit.
#include <doctest/doctest.h>

#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/database.h"
#include "core/render.h"
#include "dataflow/run.h"
#include "tests/support/pairwise.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests {

namespace {

using dataflow::Balance;
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
    CHECK(operations.total_internal_reflections == operations_.total_internal_reflections);
    return report;
  }

  const core::Database& database() const { return database_; }

 private:
  core::Database database_;
  core::RenderSettings settings_;
  core::Operations operations_;
  std::uint64_t hash_ = 0;
};

constexpr std::uint32_t node_counts[] = {1, 2, 3, 5, 8, 16, 64};
constexpr std::uint32_t no_wish = 0;
constexpr std::uint32_t ray_batches[] = {1, 3, no_wish};
constexpr std::uint32_t ray_credits[] = {1, no_wish};

/// Every pair of choices occurs in some run.
void check_pairwise(const Subject& subject) {
  for (const auto& row : pairwise({std::size(node_counts), std::size(ray_batches), std::size(ray_credits), 2, 2, 2})) {
    RunOptions options{.node_count = node_counts[row[0]]};
    if (ray_batches[row[1]] != no_wish) {
      options.ray_batch = ray_batches[row[1]];
    }
    if (ray_credits[row[2]] != no_wish) {
      options.ray_credits = ray_credits[row[2]];
    }
    options.balance = {.balance = row[3] == 0 ? Balance::subsampled : Balance::equal_size, .subsample = 4};
    options.traversal.skip_empty_space = row[4] == 0;
    if (row[5] == 1) {
      options.topology = nodes::TopologyKind::hypercube;
    }
    CAPTURE(row[1]);
    CAPTURE(row[2]);
    CAPTURE(row[3]);
    CAPTURE(row[4]);
    subject.check(options);
  }
}

/// A wall of squares whose edges and corners lie on planes that cells have as borders, before a mirror, seen square on: rays run
/// in border planes and along border edges.
core::Scene lattice() {
  core::Scene scene;
  scene.name = "lattice";
  scene.view = {.from = {0, -4, 0}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 45};
  scene.background = {0.2, 0.3, 0.4};
  scene.lights = {{{0, -4, 0}}, {{0, -4, 4}}, {{1, -2, 1}}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {0.8, 0.7, 0.5}, .diffuse = 0.6, .specular = 0.4, .shine = 20});
  for (int x = -2; x < 2; ++x) {
    for (int z = -2; z < 2; ++z) {
      const double y = 0.5 * ((x + z) & 1);
      builder.polygon(
          {{0.5 * x, y, 0.5 * z}, {0.5 * x + 0.5, y, 0.5 * z}, {0.5 * x + 0.5, y, 0.5 * z + 0.5}, {0.5 * x, y, 0.5 * z + 0.5}});
      builder.polygon({{0.5 * x, 0, 0.5 * z}, {0.5 * x, 1, 0.5 * z}, {0.5 * x, 1, 0.5 * z + 0.5}, {0.5 * x, 0, 0.5 * z + 0.5}});
    }
  }
  return scene;
}

}  // namespace

TEST_CASE("dataflow: any nodes, batches, credits, balances and skips give the picture of mirrors and glass") {
  check_pairwise(Subject(mirrors_and_glass(), 20));
}

TEST_CASE("dataflow: any nodes, batches, credits, balances and skips give the picture of gears") {
  check_pairwise(Subject(built_in("gears-2"), 16));
}

TEST_CASE("dataflow: a thousand lights need no more memory for rays and give the same picture") {
  const Subject subject(thousand_lights(), 6);
  for (const std::uint32_t nodes : {2U, 7U}) {
    const dataflow::Report report = subject.check({.node_count = nodes});
    CHECK(report.nodes[0].memory_planned[nodes::Category::ray_stacks] < 4096);
  }
}

TEST_CASE("dataflow: several samples a pixel reach both planes of the film") {
  const Subject subject(mirrors_and_glass(), 12, 5);
  subject.check({.node_count = 5});
}

TEST_CASE("dataflow: when every ray overflows the picture is the same and all of them come back from the host") {
  const Subject subject(mirrors_and_glass(), 20);
  for (const std::uint32_t nodes : {2U, 5U, 16U}) {
    const dataflow::Report report = subject.check({.node_count = nodes, .ray_batch = 1, .ray_credits = 0});
    CHECK(report.gathers().rays_overflowed == report.gathers().rays);
    CHECK(report.host_rays.rays_out > 0);
    CHECK(report.sent()[dataflow::number_of(dataflow::Kind::rays)].packets == 0);
  }
}

TEST_CASE("dataflow: triangles in border planes and rays along border edges are met by one node each") {
  const Subject subject(lattice(), 33);
  const core::Corner size = core::grid_size(subject.database().header().frame);
  for (const std::uint32_t nodes : {2U, 4U, 13U, 64U}) {
    subject.check({.node_count = nodes, .balance = {.balance = Balance::equal_size}});
    for (const dataflow::CutAxes& axes : {dataflow::CutAxes{0, 1}, dataflow::CutAxes{1, 2}}) {
      subject.check({.node_count = nodes, .make_bsp = [&](std::uint32_t n) { return dataflow::equal_size_bsp(size, axes, n); }});
    }
  }
}

TEST_CASE("dataflow: repeated runs give one picture and the same counts of rays between each two nodes") {
  const Subject subject(mirrors_and_glass(), 16);
  const std::vector<std::uint64_t> matrix = subject.check({.node_count = 6}).ray_matrix();
  for (int i = 0; i < 20; ++i) {
    CHECK(subject.check({.node_count = 6}).ray_matrix() == matrix);
  }
}

TEST_CASE("dataflow: chaos leaves the picture as it is") {
  const Subject subject(mirrors_and_glass(), 12);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    RunOptions options{.node_count = static_cast<std::uint32_t>(2 + seed % 6), .chaos = nodes::chaos_of(seed)};
    if (seed % 3 == 0) {
      options.ray_batch = 1;
      options.ray_credits = static_cast<std::uint32_t>(seed % 2);
    }
    subject.check(options);
  }
}

TEST_CASE("dataflow: the report's figures fit together") {
  const Subject subject(mirrors_and_glass(), 20);
  const dataflow::Report report = subject.check({.node_count = 8, .topology = nodes::TopologyKind::mesh});
  std::uint64_t rays = 0;
  const std::vector<std::uint64_t> matrix = report.ray_matrix();
  REQUIRE(matrix.size() == 64);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    rays += matrix[i];
    CHECK((i % 9 != 0 || matrix[i] == 0));  // no ray goes to its own node
  }
  CHECK(rays == report.gathers().rays);
  CHECK(report.messages_per_ray() > 0);
  CHECK(report.mean_fill() > 0);
  CHECK(report.mean_fill() <= 1);
  CHECK(report.duplication >= 1);
  CHECK(report.predicted.size() == 8);
  CHECK(dataflow::average_load(report.work()) > 0.1);
  for (const dataflow::NodeReport& node : report.nodes) {
    CHECK(node.memory_used.bytes == node.memory_planned.bytes);
  }
}

TEST_CASE("dataflow: a scene that does not fit says which number of nodes works, and it does") {
  const Subject subject(built_in("tetra-5"), 8);
  RunOptions options{.node_count = 1, .ray_batch = 1, .ray_credits = 1, .balance = {.balance = Balance::equal_size}};
  options.node_memory_bytes = subject.run(options).plan.node_memory_max_bytes() - (std::size_t{40} << 10U);
  std::string error;
  try {
    subject.run(options);
  } catch (const core::InputError& e) {
    error = e.what();
  }
  INFO(error);
  const std::size_t at = error.find("with this memory --nodes=");
  REQUIRE(at != std::string::npos);
  options.node_count = static_cast<std::uint32_t>(std::stoul(error.substr(at + 25)));
  CHECK(options.node_count > 1);
  subject.check(options);
}

TEST_CASE("dataflow: a stop request interrupts the run") {
  const core::Database database = core::build_database(mirrors_and_glass(), {});
  const core::RenderSettings settings{
      database.header(), core::Camera(mirrors_and_glass().view, database.header().frame, 64, 64, 1), {}};
  std::stop_source source;
  source.request_stop();
  CHECK(dataflow::run_dataflow(database, settings, {.node_count = 3}, source.get_token()).end == nodes::RunEnd::interrupted);
}

}  // namespace dmpc::tests
