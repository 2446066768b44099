// What a run reports, where it can be worked out by hand or from its nodes' own counts.
#include "dataflow/run.h"
#include "core/picture/heat_kind.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/trace/work.h"
#include "tests/support/border_scene.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dataflow_run_test {

using namespace dmpc;
using dataflow::Kind;
using dataflow::NodeReport;
using dataflow::number_of;
using dataflow::Report;
using dataflow::RunOptions;
using tests::Subject;

namespace {

Report run(const Subject& subject, const RunOptions& options) {
  return dataflow::run_dataflow(subject.database(), subject.settings(), options, {});
}
/// Every ray asks every region on its way.
Report run_asking(const Subject& subject, const RunOptions& options) {
  return dataflow::run_dataflow(subject.database(), subject.settings({.empty_regions = false}), options, {});
}

std::uint64_t sum(const std::array<std::uint64_t, core::ray_kind_count>& by_kind) {
  return std::accumulate(by_kind.begin(), by_kind.end(), std::uint64_t{0});
}

/// One ray through a grid of two macro cells each way, along x, past everything: from the low half to the high half, into the
/// sky.
Subject lone_ray() {
  core::Scene scene = tests::BorderScene().scene();
  scene.view = {.from = {-3, -0.7, -0.7}, .at = {0, -0.7, -0.7}, .up = {0, 0, 1}};
  return Subject(scene, {1, 1}, tests::BorderScene::options());
}

/// Regions of equal size, the first cut across x, the second across y.
RunOptions cut_across_x(const Subject& subject, std::uint32_t node_count) {
  const core::Corner size = core::grid_size(subject.settings().header.frame);
  const dataflow::MakeRegions make_regions = [=](std::uint32_t count) {
    return dataflow::equal_size_bsp(size, {0, 1}, count, {.order = dataflow::CutOrder::alternating});
  };
  return {.computer = {.node_count = node_count}, .make_regions = make_regions};
}

}  // namespace

TEST_CASE("a ray that passes from one region to the other is one message in a packet of its own") {
  const Subject subject = lone_ray();
  const Report report = run_asking(subject, cut_across_x(subject, 2));
  CHECK(tests::outcome_of(report) == subject.outcome());
  CHECK(report.ray_matrix() == std::vector<std::uint64_t>{0, 1, 0, 0});
  REQUIRE(report.ray_flows().size() == 1);
  CHECK((report.ray_flows()[0].first == 0 && report.ray_flows()[0].second == 1 && report.ray_flows()[0].amount == 1));
  CHECK(report.messages_per_ray() == 1.0);
  CHECK(report.mean_fill() == 1.0 / report.plan.ray_batch);
  CHECK(report.nodes[0].primary_rays == 1);
  CHECK(report.nodes[1].primary_rays == 0);
  CHECK(report.nodes[0].program.rays.ended == 0);
  CHECK(report.nodes[1].program.rays.ended == 1);
  CHECK(report.sent()[number_of(Kind::rays)].packets == 1);
  CHECK(report.sent()[number_of(Kind::rays)].bytes == sizeof(nodes::PacketHeader) + dataflow::ray_packet_bytes(1));
  CHECK(dataflow::ray_traffic(report.sent()).bytes == report.sent()[number_of(Kind::rays)].bytes);
  CHECK(report.host_rays.rays_in == 0);
}

TEST_CASE("a ray that meets nothing on its way asks no region") {
  const Subject subject = lone_ray();
  const Report report = run(subject, cut_across_x(subject, 2));
  CHECK(tests::outcome_of(report) == subject.outcome());
  CHECK(report.messages_per_ray() == 0.0);
  CHECK(report.rays().ended == 1);
}

TEST_CASE("the same ray by way of the host is one message, too") {
  const Subject subject = lone_ray();
  RunOptions options = cut_across_x(subject, 2);
  options.rays.ray_batch = 1;
  options.rays.ray_credits = 0;
  const Report report = run_asking(subject, options);
  CHECK(report.ray_matrix() == std::vector<std::uint64_t>{0, 1, 0, 0});
  CHECK(report.messages_per_ray() == 1.0);
  CHECK(report.mean_fill() == 1.0);
  CHECK(report.sent()[number_of(Kind::rays)].packets == 0);
  CHECK(report.sent()[number_of(Kind::overflow)].packets == 1);
  CHECK(report.sent()[number_of(Kind::forwarded)].packets == 1);
  CHECK(dataflow::ray_traffic(report.sent()).packets == 2);
  CHECK(report.host_rays.rays_in == 1);
  CHECK(report.host_rays.rays_out == 1);
  CHECK(report.host_rays.rays_buffered_max == 1);
}

TEST_CASE("a node whose region no ray enters sleeps but for the token, and sends no ray and no light") {
  const Subject subject = lone_ray();
  const Report report = run_asking(subject, cut_across_x(subject, 4));
  CHECK(tests::outcome_of(report) == subject.outcome());
  int idle = 0;
  for (const NodeReport& node : report.nodes) {
    if (node.primary_rays > 0 || sum(node.program.rays.in) > 0) {
      continue;
    }
    ++idle;
    CHECK(core::work_of(node.program.operations) == 0);
    CHECK(sum(node.program.rays.out) == 0);
    CHECK(node.counters.sent[number_of(Kind::film)].packets == 0);
    CHECK(node.counters.sent[number_of(Kind::credits)].packets == 0);
    // One quantum at the start, one for each visit of the token, and one each for the ends of rays and of the run.
    CHECK(node.counters.quanta <= report.host_rays.token_rounds + 3);
  }
  CHECK(idle == 2);
}

TEST_CASE("a node whose region is empty holds next to nothing and takes part in the end") {
  const Subject subject(tests::mirrors_and_glass(), {12, 12});
  // A cut one finest cell from the grid's border: behind it lies only the grid's margin.
  const core::Corner size = core::grid_size(subject.settings().header.frame);
  const dataflow::MakeRegions make_regions = [&](std::uint32_t count) {
    dataflow::ColumnLoads loads(dataflow::ColumnLattice(size, {0, 1}, size[0]));
    loads.load.back() = 1;  // all of the load lies in one corner
    return dataflow::build_bsp(loads, count);
  };
  const Report report = run(subject, {.computer = {.node_count = 3}, .make_regions = make_regions});
  CHECK(tests::outcome_of(report) == subject.outcome());
  int empty = 0;
  for (const NodeReport& node : report.nodes) {
    empty += node.primitive_copies == 0 ? 1 : 0;
    CHECK((node.primitive_copies > 0 || node.part_bytes < 4096));
  }
  CHECK(empty >= 1);
}

TEST_CASE("one node keeps every ray, and holds every record once") {
  const Subject subject(tests::mirrors_and_glass(), {12, 12});
  const Report report = run(subject, {.computer = {.node_count = 1}});
  CHECK(tests::outcome_of(report) == subject.outcome());
  CHECK(report.ray_matrix() == std::vector<std::uint64_t>{0});
  CHECK(report.messages_per_ray() == 0.0);
  CHECK(report.mean_fill() == 1.0);
  CHECK(report.duplication == 1.0);
  CHECK(report.nodes[0].primitive_copies == subject.database().references());
  CHECK(report.nodes[0].primary_rays == 144);
  CHECK(report.gathers().packets == 0);
  for (const Kind kind : {Kind::rays, Kind::overflow, Kind::forwarded, Kind::credits}) {
    CHECK(report.sent()[number_of(kind)].packets == 0);
  }
}

TEST_CASE("a report's sums are those of its nodes") {
  const Subject subject(tests::mirrors_and_glass(), {16, 16});
  const Report report = run(subject, {.computer = {.node_count = 5}});
  const std::vector<std::uint64_t> matrix = report.ray_matrix();
  const std::vector<double> work = report.work();
  REQUIRE(matrix.size() == 25);
  REQUIRE(work.size() == 5);
  std::uint64_t copies = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    const NodeReport& node = report.nodes[i];
    std::uint64_t row = 0, column = 0;
    for (std::size_t j = 0; j < 5; ++j) {
      row += matrix[5 * i + j];
      column += matrix[5 * j + i];
    }
    CHECK(row == sum(node.program.rays.out));
    CHECK(column == sum(node.program.rays.in));
    CHECK(row == node.program.gather.rays);
    CHECK(matrix[6 * i] == 0);
    CHECK(work[i] == static_cast<double>(core::work_of(node.program.operations)));
    const dataflow::Bsp& bsp = *report.regions.bsp();
    CHECK(node.region == bsp.region_at(bsp.region_index_of(nodes::NodeId{static_cast<std::uint32_t>(i)})));
    copies += node.primitive_copies;
  }
  CHECK(report.duplication == static_cast<double>(copies) / static_cast<double>(subject.database().references()));
  CHECK(std::accumulate(work.begin(), work.end(), 0.0) == static_cast<double>(core::work_of(report.operations())));
  CHECK(report.messages_per_ray() ==
        static_cast<double>(report.gathers().rays) / static_cast<double>(sum(subject.outcome().rays)));
  CHECK(report.sent()[number_of(Kind::done)].packets == 5);
  CHECK(report.sent()[number_of(Kind::stop)].packets == 5);
}

TEST_CASE("what is prepared is what runs, as often as one likes") {
  const Subject subject(tests::mirrors_and_glass(), {12, 12});
  const RunOptions options{.computer = {.node_count = 3}, .rays = {.topology = nodes::TopologyKind::mesh}};
  const dataflow::Prepared prepared = dataflow::prepare(subject.database(), subject.settings(), options);
  for (int i = 0; i < 2; ++i) {
    const Report report = dataflow::run_prepared(prepared, subject.settings(), options, {});
    CHECK(tests::outcome_of(report) == subject.outcome());
    CHECK(report.predicted == prepared.predicted);
    CHECK(report.duplication == prepared.duplication);
    for (std::uint32_t node = 0; node < 3; ++node) {
      CHECK(report.nodes[node].part_bytes == prepared.distribution.parts[node].record_bytes);
      CHECK(report.nodes[node].memory_used.bytes == prepared.plan.node_memory(node).bytes);
    }
  }
}

TEST_CASE("the host may forget the parts once they are distributed, and the outcome is the same") {
  const Subject subject(tests::mirrors_and_glass(), {12, 12});
  RunOptions options{.computer = {.node_count = 3}};
  dataflow::Prepared prepared = dataflow::prepare(subject.database(), subject.settings(), options);
  const std::size_t part_bytes = prepared.distribution.parts[1].record_bytes;
  int times = 0;
  options.watching.distributed = [&] {
    ++times;
    prepared.distribution.forget_records();
  };
  const Report report = dataflow::run_prepared(prepared, subject.settings(), options, {});
  CHECK(tests::outcome_of(report) == subject.outcome());
  CHECK(report.nodes[1].part_bytes == part_bytes);
  CHECK(times == 1);
}

TEST_CASE("rays that walk in bundles travel as they do alone, from node to node, and give the same picture") {
  const Subject subject(tests::mirrors_and_glass(), {32, 32});
  const auto run_with = [&](std::uint32_t nodes, bool bundles) {
    return dataflow::run_dataflow(subject.database(), subject.settings({.bundles = bundles}), {.computer = {.node_count = nodes}},
                                  {});
  };
  for (const std::uint32_t nodes : {1U, 2U, 5U, 16U}) {
    CAPTURE(nodes);
    const Report together = run_with(nodes, true), alone = run_with(nodes, false);
    CHECK(tests::outcome_of(together) == subject.outcome());
    CHECK(tests::outcome_of(alone) == subject.outcome());
    CHECK(together.rays().in == alone.rays().in);
    CHECK(together.rays().ended == alone.rays().ended);
    CHECK(together.rays().hits_sent_back == alone.rays().hits_sent_back);
    CHECK(together.ray_matrix() == alone.ray_matrix());
    CHECK(together.operations().rays_in_bundles > together.operations().bundles);
    CHECK(together.operations().rays_in_bundles >= together.operations().ray_count() / 2);
    CHECK(alone.operations().bundles == 0);
    for (const NodeReport& node : together.nodes) {
      CHECK(node.memory_used.bytes == node.memory_planned.bytes);
    }
  }
}

TEST_CASE("rays walk in bundles on threads, unless single ones are watched or that skip is off") {
  const Subject subject(tests::mirrors_and_glass(), {8, 8});
  const auto rays_a_task = [&](const RunOptions& options, const core::Skips& skips = {}) {
    return run_dataflow(subject.database(), subject.settings(skips), options, {}).plan.rays_a_task;
  };
  constexpr std::array kinds{core::HeatKind::rays};
  nodes::HeatMap heat(64, kinds);
  CHECK(rays_a_task({.computer = {.node_count = 2}}) == 16);
  CHECK(rays_a_task({.computer = {.node_count = 2}}, {.bundles = false}) == 1);
  CHECK(rays_a_task({.computer = {.node_count = 2, .machine = nodes::Machine{}}}) == 1);
  CHECK(rays_a_task({.computer = {.node_count = 2}, .watching = {.heat = &heat}}) == 1);
}

}  // namespace dataflow_run_test
