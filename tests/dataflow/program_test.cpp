// The node program and the host's: one ray at a time between nodes without threads, then whole computers in any legal order.
#include "dataflow/program.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "core/base/counts.h"
#include "core/picture/render.h"
#include "dataflow/distribution.h"
#include "dataflow/host.h"
#include "dataflow/regions/balance.h"
#include "dataflow/run.h"
#include "tests/support/shuffled_machine.h"
#include "tests/support/small_scenes.h"

namespace dataflow_program_test {

using namespace dmpc;
using dataflow::Kind;
using dataflow::RayMessage;
using nodes::NodeId;
using tests::Parcel;

namespace {

/// A scene cut up for some nodes, its plan, and its picture by the reference renderer.
struct Stage {
  Stage(const core::Scene& scene, std::uint32_t node_count, int side, const dataflow::PlanRequest& bounds = {})
      : database(core::build_database(scene, {})),
        settings{database.header(), core::Camera(scene.view, database.header().frame, side, side, 1), {}},
        distribution(dataflow::distribute(database, settings,
                                          dataflow::equal_size_bsp(core::grid_size(settings.header.frame),
                                                                   dataflow::axes_facing(settings.camera), node_count))),
        plan(plan_of(bounds)) {}

  dataflow::Plan plan_of(dataflow::PlanRequest request) const {
    request.shares = distribution.shares();
    request.width = static_cast<std::uint32_t>(settings.camera.width());
    request.height = static_cast<std::uint32_t>(settings.camera.height());
    return dataflow::make_plan(request);
  }
  std::uint64_t reference_hash(core::Operations& operations) const {
    core::LocalRecords records(database.bytes());
    core::GridTracer tracer(records, settings.header, core::Skips{});
    return core::render(tracer, settings, operations).hash();
  }

  core::Database database;
  core::RenderSettings settings;
  dataflow::Distribution distribution;
  dataflow::Plan plan;
};

/// One node of a stage, with the primary rays given.
struct LoneProgram {
  LoneProgram(const Stage& stage, std::uint32_t index, std::span<const dataflow::PrimaryRun> primaries = {})
      : single(stage.plan.node_memory(index), index, stage.plan.node_count() + 1),
        made(
            dataflow::make_node_program(single.node, stage.plan,
                                        {stage.distribution.parts[index].header, std::span(stage.distribution.parts[index].bytes),
                                         primaries, stage.settings, stage.distribution.regions, stage.distribution.proxy})),
        program(*made) {}

  void receive(std::uint32_t sender, const RayMessage& message) {
    const dataflow::RayPacketHeader header{1, static_cast<std::uint16_t>(nodes::index_of(single.node.id()))};
    std::vector<std::byte> payload(dataflow::ray_packet_bytes(1));
    std::memcpy(payload.data(), &header, sizeof(header));
    std::memcpy(payload.data() + sizeof(header), &message, dataflow::ray_message_bytes(0));
    program.receive({NodeId{sender}, dataflow::number_of(Kind::rays), payload});
  }
  void work_to_rest() {
    while (program.work() || program.has_leftovers()) {
    }
  }
  std::vector<RayMessage> rays_sent() const {
    std::vector<RayMessage> rays;
    for (const Parcel& parcel : single.post.parcels) {
      for (std::size_t at = sizeof(dataflow::RayPacketHeader); Kind{parcel.kind} == Kind::rays && at < parcel.payload.size();
           at += dataflow::ray_message_bytes(0)) {
        rays.emplace_back();
        std::memcpy(static_cast<void*>(&rays.back()), parcel.payload.data() + at, dataflow::ray_message_bytes(0));
      }
    }
    return rays;
  }

  tests::SingleNode single;
  std::unique_ptr<dataflow::NodeProgram> made;
  dataflow::NodeProgram& program;
};

/// A primary ray that hits in the region in which it enters, its first passage and its hit in that region's part.
struct LocalHit {
  std::uint32_t owner = 0;
  core::Ray ray;
  core::Passage passage;
  core::Hit hit;
};

LocalHit find_local_hit(const Stage& stage) {
  for (std::uint32_t pixel = 0; pixel < stage.settings.camera.pixel_count(); ++pixel) {
    const core::Ray ray = stage.settings.camera.primary_ray(pixel, 0);
    const auto passage = core::first_passage(ray, stage.settings.header.frame);
    const std::uint32_t owner = passage ? nodes::index_of(stage.distribution.regions.owner_of(passage->cell)) : 0;
    const core::DatabasePart& part = stage.distribution.parts[owner];
    core::LocalRecords records(part.bytes);
    core::Operations operations;
    core::Cursor cursor = passage ? core::arrive(*passage) : core::Cursor{};
    if (passage && core::trace(ray, cursor, records, part.header, {}, operations) == core::Traced::hit) {
      return {owner, ray, *passage, cursor.best};
    }
  }
  REQUIRE(false);
  return {};
}

}  // namespace

TEST_CASE("a hit that is confirmed but not met here goes to its finder with the finder's address") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16);
  const LocalHit found = find_local_hit(stage);
  const std::uint32_t other = 1 - found.owner;
  LoneProgram node(stage, found.owner);
  core::Passage passage = found.passage;
  // Nearer than anything in this region, and of no primitive that there is.
  passage.best = {static_cast<float>(passage.t_enter) + 1e-6F, 0x00ffffff, core::Address{0x7ffffff0}, 3};
  node.receive(other, dataflow::message_of(found.ray, passage, NodeId{other}));
  node.work_to_rest();
  const std::vector<RayMessage> sent = node.rays_sent();
  REQUIRE(sent.size() == 1);
  CHECK(sent[0].is_confirmed == 1);
  CHECK(sent[0].finder == other);
  CHECK(sent[0].best.leaf == core::Address{0x7ffffff0});
  CHECK(sent[0].best.lane == 3);
  CHECK(sent[0].ray.pixel == found.ray.pixel);
  const dataflow::ProgramReport report = node.program.report();
  CHECK(report.rays.hits_sent_back == 1);
  CHECK(report.operations.primary_hits == 0);
  CHECK(report.rays.ended == 0);
}

TEST_CASE("a node refuses what is not sent to nodes, and rays that are not its own") {
  const Stage stage(tests::mirrors_and_glass(), 2, 8);
  LoneProgram node(stage, 0);
  CHECK_THROWS_AS(node.program.receive({NodeId{1}, dataflow::number_of(Kind::overflow), {}}), core::InternalError);
  const dataflow::RayPacketHeader header{1, 1};
  std::vector<std::byte> payload(dataflow::ray_packet_bytes(1));
  std::memcpy(payload.data(), &header, sizeof(header));
  CHECK_THROWS_AS(node.program.receive({NodeId{1}, dataflow::number_of(Kind::rays), payload}), core::InternalError);
  payload.pop_back();
  CHECK_THROWS_AS(node.program.receive({NodeId{1}, dataflow::number_of(Kind::rays), payload}), core::InternalError);
  CHECK_THROWS_AS(node.program.receive({NodeId{2}, dataflow::number_of(Kind::stop), std::as_bytes(std::span(&header, 0))}),
                  core::InternalError);
}

TEST_CASE("a node that holds its primary rays back gives back credits but keeps the token") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16, {.rays = {.ray_batch = 1, .ray_credits = 1, .queue_packets = 2}});
  LoneProgram node(stage, 0, stage.distribution.primaries[0]);
  node.work_to_rest();  // a ray has left for node 1, which does not answer
  const dataflow::OverflowTaken taken{dataflow::host_rays_wanted_max};
  node.program.receive({NodeId{2}, dataflow::number_of(Kind::overflow_taken), std::as_bytes(std::span(&taken, 1))});
  node.work_to_rest();
  CHECK(node.program.describe().find("holds primary rays back") != std::string::npos);
  const std::size_t sent = node.single.post.parcels.size();
  CHECK(sent > 0);
  const dataflow::Token token;
  node.program.receive({NodeId{1}, dataflow::number_of(Kind::token), std::as_bytes(std::span(&token, 1))});
  node.work_to_rest();
  CHECK(node.single.post.parcels.size() == sent);
  CHECK(node.program.describe().find("holds the token") != std::string::npos);
  const dataflow::Credits credits{1};
  node.program.receive({NodeId{1}, dataflow::number_of(Kind::credits), std::as_bytes(std::span(&credits, 1))});
  node.work_to_rest();
  CHECK(node.single.post.parcels.size() > sent);
}

TEST_CASE("a node holds its primary rays back while its queue is full and the host says that it buffers enough") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16, {.rays = {.ray_batch = 1, .ray_credits = 1, .queue_packets = 2}});
  LoneProgram node(stage, 0, stage.distribution.primaries[0]);
  const auto receive = [&](std::uint32_t sender, Kind kind, const auto& packet) {
    node.program.receive({NodeId{sender}, dataflow::number_of(kind), std::as_bytes(std::span(&packet, 1))});
  };
  const auto started = [&] {
    node.work_to_rest();
    return node.program.report().operations.rays[0];
  };
  const std::uint64_t first = started();  // nobody answers, so it waits for a credit of the host's
  receive(2, Kind::overflow_taken, dataflow::OverflowTaken{dataflow::host_rays_wanted_max});
  const std::uint64_t second = started();
  receive(2, Kind::overflow_taken, dataflow::OverflowTaken{dataflow::host_rays_wanted_max});
  CHECK(started() == second);
  CHECK(node.program.describe().find("holds primary rays back") != std::string::npos);
  receive(1, Kind::credits, dataflow::Credits{1});  // a packet leaves the queue
  CHECK(started() > second);
  CHECK(second >= first);
}

TEST_CASE("a node that rests gives back the credit of a ray that it has taken up") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16);
  const LocalHit found = find_local_hit(stage);
  LoneProgram node(stage, found.owner);
  node.receive(1 - found.owner, dataflow::message_of(found.ray, found.passage, NodeId{found.owner}));
  node.work_to_rest();
  std::uint32_t given_back = 0;
  for (const Parcel& parcel : node.single.post.parcels) {
    given_back += Kind{parcel.kind} == Kind::credits ? parcel.packet().as<dataflow::Credits>().count : 0;
  }
  CHECK(given_back == 1);
  CHECK(node.single.memory.used().bytes == [&] {
    nodes::MemoryPlan planned = stage.plan.node_memory(found.owner);
    planned[nodes::Category::mailbox] = 0;                                                    // the runner's
    planned[nodes::Category::queues] -= nodes::LocalMemory::bytes_for<dataflow::PrimaryRun>(  // it was assigned none
        stage.distribution.primaries[found.owner].size());
    return planned.bytes;
  }());
}

namespace {

/// Runs a stage's whole computer in the order of a seed; everything must come out as the reference renderer has it.
void run_shuffled(const Stage& stage, std::uint64_t seed) {
  CAPTURE(seed);
  core::Operations expected;
  const std::uint64_t hash = stage.reference_hash(expected);
  core::Film film(stage.settings.camera.width(), stage.settings.camera.height());
  const dataflow::RunOptions options;
  const auto specifications = dataflow::specifications_of(stage.plan, stage.distribution, stage.settings, film, options);
  tests::ShuffledComputer computer(specifications, seed);
  computer.run();
  CHECK(film.hash() == hash);
  core::Operations operations;
  dataflow::RayCounters rays;
  for (std::uint32_t i = 0; i < stage.plan.node_count(); ++i) {
    const auto report = dynamic_cast<const dataflow::NodeProgram&>(computer.program(i)).report();
    core::add_counts(operations, report.operations);
    core::add_counts(rays, report.rays);
    CHECK(computer.node(i).credits(stage.plan.host(), dataflow::ray_channel) == stage.plan.host_credits);
  }
  CHECK(operations.rays == expected.rays);
  CHECK(operations.shadings == expected.shadings);
  CHECK(rays.in == rays.out);
}

}  // namespace

TEST_CASE("any legal order of events gives the same film, and no mailbox overflows") {
  for (std::uint64_t seed = 0; seed < 36; ++seed) {
    dataflow::PlanRequest bounds;
    bounds.rays.ray_batch = seed % 3 == 0 ? 1 : seed % 3 == 1 ? 3 : 10;
    if (seed % 3 == 2) {
      bounds.rays.ray_slots = 1 + seed % 4;
    } else {
      bounds.rays.ray_credits = seed % 4;
    }
    bounds.rays.queue_packets = seed % 5 * 2;
    bounds.bundles = seed / 4 % 2 == 0;
    run_shuffled(Stage(tests::mirrors_and_glass(), static_cast<std::uint32_t>(1 + seed % 7), 8, bounds), seed);
  }
}

TEST_CASE("nodes that share an owner's only place, without a queue, go on by way of the host") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    dataflow::PlanRequest bounds;
    bounds.rays = {.ray_batch = 2, .ray_slots = 1, .queue_packets = 0};
    bounds.bundles = seed % 2 == 0;
    run_shuffled(Stage(tests::mirrors_and_glass(), 6, 8, bounds), seed);
  }
}

TEST_CASE("one node alone never sends a ray") {
  const Stage stage(tests::mirrors_and_glass(), 1, 8);
  run_shuffled(stage, 1);
}

TEST_CASE("a bundle whose packet waits keeps its other rays, and goes on with them when a credit has come") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16, {.rays = {.ray_batch = 1, .ray_credits = 0}, .bundles = true});
  LoneProgram node(stage, 0, stage.distribution.primaries[0]);
  const auto overflowed = [&] {
    return std::count_if(node.single.post.parcels.begin(), node.single.post.parcels.end(),
                         [](const Parcel& parcel) { return Kind{parcel.kind} == Kind::overflow; });
  };
  node.work_to_rest();  // packets have left for the host, which does not answer
  for (int turn = 0; turn < 40; ++turn) {
    CAPTURE(turn);
    const auto before = overflowed();
    CHECK(node.program.describe().find("(a packet waits for room)") != std::string::npos);
    const dataflow::OverflowTaken taken{1};
    node.program.receive({stage.plan.host(), dataflow::number_of(Kind::overflow_taken), std::as_bytes(std::span(&taken, 1))});
    node.work_to_rest();
    CHECK(overflowed() == before + 1);
  }
}

TEST_CASE("a node with bundles gives others time to fill its packets before it sends them") {
  const Stage stage(tests::mirrors_and_glass(), 2, 16, {.bundles = true});
  LoneProgram node(stage, 0, stage.distribution.primaries[0]);
  while (node.program.work()) {
  }
  const std::size_t sent = node.rays_sent().size();
  CHECK(node.program.has_leftovers());
  CHECK_FALSE((node.program.work(), node.program.has_leftovers()));
  CHECK(node.rays_sent().size() > sent);
}

}  // namespace dataflow_program_test
