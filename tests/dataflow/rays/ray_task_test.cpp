#include "dataflow/rays/ray_task.h"

#include <doctest/doctest.h>

#include <array>
#include <optional>

#include "core/trace/traversal.h"
#include "tests/dataflow/part_bench.h"

namespace ray_task_test {

using namespace dmpc;
using dataflow::RayMessage;
using dataflow::RayTask;
using nodes::NodeId;
using tests::elsewhere;
using tests::half;
using tests::other;
using tests::self;
using tests::Subject;
using tests::whole;

namespace {

const Subject& subject() { return tests::part_subject(); }
const core::GridFrame& frame() { return subject().settings().header.frame; }

struct Bench : tests::PartBench<RayTask> {
  using PartBench::PartBench;

  core::Traced trace() {
    task.trace(tracer, part.header, operations);
    CHECK(task.has_ended());
    task.drop_ended();
    return task.traced();
  }
  std::optional<core::Ray> next_child() {
    std::optional<core::Ray> child;
    task.next_children(
        tracer, settings, operations, [&](const auto& make) { REQUIRE(make(child.emplace())); }, tests::no_shine);
    return child;
  }
};

/// A ray as it is sent to the owner of the cell in which it starts; of this node's own making unless said otherwise.
std::optional<RayMessage> starting(const core::Ray& ray, NodeId finder = self) {
  const auto passage = core::first_passage(ray, frame());
  return passage ? std::optional(dataflow::message_of(ray, *passage, finder)) : std::nullopt;
}

/// The first primary ray that starts in the region and to which tracing it there answers so.
RayMessage primary_that(core::Traced traced, const core::Region& region) {
  for (std::uint32_t pixel = 0; pixel < subject().settings().camera.pixel_count(); ++pixel) {
    const auto message = starting(subject().settings().camera.primary_ray(pixel, 0));
    if (message && region.contains(message->cell)) {
      Bench bench(region);
      bench.task.enter(*message);
      if (bench.trace() == traced) {
        return *message;
      }
    }
  }
  REQUIRE(false);
  return {};
}

/// Renders with one task what it can hold: every child stays, or misses the grid.
void trace_to_the_end(Bench& bench, const core::Ray& primary, std::array<std::uint64_t, core::ray_kind_count>& rays) {
  for (std::optional<core::Ray> ray = primary; ray; ray = bench.next_child()) {
    ++rays[static_cast<std::size_t>(ray->kind)];
    const auto message = starting(*ray);
    if (!message) {
      continue;
    }
    bench.task.enter(*message);
    if (bench.trace() == core::Traced::hit && ray->kind != core::RayKind::shadow) {
      bench.task.shade_hit();
    }
  }
}

}  // namespace

TEST_CASE("a task takes exactly the memory that it has named, and starts with nothing under way") {
  const Bench bench(whole());
  CHECK(bench.memory.used().bytes == nodes::MemoryPlan(RayTask::layout(5)).bytes);
  CHECK(bench.task.is_idle());
  CHECK(!bench.task.has_rays());
}

TEST_CASE("a task over the whole scene shoots every ray of the reference renderer, depth first on a stack of a hit a depth") {
  Bench bench(whole(), 5);
  std::array<std::uint64_t, core::ray_kind_count> rays{};
  for (std::uint32_t pixel = 0; pixel < subject().settings().camera.pixel_count(); ++pixel) {
    trace_to_the_end(bench, subject().settings().camera.primary_ray(pixel, 0), rays);
    CHECK(bench.task.is_idle());
  }
  CHECK(rays == subject().outcome().rays);
  CHECK(bench.operations.shadings == subject().outcome().shadings);
}

TEST_CASE("a ray is under way from where it enters until it has been traced, its hit until it has made its last child") {
  Bench bench(whole());
  bench.task.enter(primary_that(core::Traced::hit, whole()));
  CHECK(bench.task.has_rays());
  CHECK(bench.trace() == core::Traced::hit);
  CHECK(!bench.task.has_rays());
  CHECK(bench.task.is_idle());
  CHECK(bench.task.found_here());
  bench.task.shade_hit();
  CHECK(!bench.task.is_idle());
  while (bench.next_child()) {  // they are the caller's
  }
  CHECK(bench.task.is_idle());
}

TEST_CASE("a ray that leaves the region goes to the owner of the next cell, and leaves nothing behind") {
  const RayMessage message = primary_that(core::Traced::left, half(0));
  Bench bench(half(0));
  bench.task.enter(message);
  CHECK(bench.trace() == core::Traced::left);
  CHECK(bench.task.is_idle());
  const RayMessage leaving = bench.task.leaving();
  CHECK(half(1).contains(leaving.cell));
  CHECK(leaving.t_enter > message.t_enter);
  CHECK(leaving.entry_axis < 3);
  CHECK(leaving.ray.pixel == message.ray.pixel);
  CHECK(leaving.is_confirmed == 0);
}

TEST_CASE("a candidate that was found elsewhere keeps its finder and its address while nothing nearer is found") {
  RayMessage message = primary_that(core::Traced::left, half(0));
  message.finder = 9;
  message.best = {1e6F, 5, elsewhere, 2};
  Bench bench(half(0));
  bench.task.enter(message);
  REQUIRE(bench.trace() == core::Traced::left);
  CHECK(!bench.task.found_here());
  CHECK(NodeId{bench.task.leaving().finder} == other);
  CHECK(bench.task.leaving().best.leaf == elsewhere);
  CHECK(bench.task.leaving().best.lane == 2);
}

TEST_CASE("a candidate that is met here, too, or one behind what is met here, makes this node the finder") {
  RayMessage message = primary_that(core::Traced::hit, whole());
  Bench finder(whole());
  finder.task.enter(message);
  finder.trace();
  core::Hit met = finder.task.leaving().best, farther = met;
  met.leaf = farther.leaf = elsewhere;
  farther.t *= 2;
  for (const core::Hit& candidate : {met, farther}) {
    message.finder = 9;
    message.best = candidate;
    Bench bench(whole());
    bench.task.enter(message);
    CHECK(bench.trace() == core::Traced::hit);
    CHECK(bench.task.found_here());
    CHECK(bench.task.leaving().best.t == met.t);
    CHECK(NodeId{bench.task.leaving().finder} == self);
    CHECK(bench.task.leaving().best.leaf != elsewhere);
  }
}

TEST_CASE("a hit that was found elsewhere is confirmed to its finder, and not shaded here") {
  RayMessage message = primary_that(core::Traced::hit, whole());
  message.finder = 9;
  message.best = {static_cast<float>(message.t_enter) + 1e-6F, 0x00ffffff, elsewhere, 3};  // nearer than any primitive
  Bench bench(whole());
  bench.task.enter(message);
  REQUIRE(bench.trace() == core::Traced::hit);
  CHECK(bench.task.finder() == other);
  const RayMessage confirmed = bench.task.confirmed_hit();
  CHECK(confirmed.is_confirmed == 1);
  CHECK(NodeId{confirmed.finder} == other);
  CHECK(confirmed.best.leaf == elsewhere);
  CHECK(confirmed.best.lane == 3);
  CHECK(confirmed.best.t == message.best.t);
  CHECK_THROWS_AS(bench.task.shade_hit(), core::InternalError);
}

TEST_CASE("a confirmed hit that comes home is shaded like one that never left") {
  const RayMessage message = primary_that(core::Traced::hit, whole());
  Bench stayed(whole()), resumed(whole());
  stayed.task.enter(message);
  stayed.trace();
  RayMessage confirmed = stayed.task.leaving();
  CHECK_THROWS_AS(stayed.task.confirmed_hit(), core::InternalError);
  stayed.task.shade_hit();
  confirmed.is_confirmed = 1;
  resumed.task.resume_hit(confirmed);
  for (;;) {
    const auto expected = stayed.next_child(), child = resumed.next_child();
    REQUIRE(child.has_value() == expected.has_value());
    if (!child) {
      break;
    }
    CHECK(child->kind == expected->kind);
    CHECK(child->direction == expected->direction);
    CHECK(child->weight == expected->weight);
  }
}

TEST_CASE("a task refuses a second ray, another finder's hit, and a hit too deep for its stack") {
  const RayMessage message = primary_that(core::Traced::hit, whole());
  Bench bench(whole(), 1);
  bench.task.enter(message);
  CHECK_THROWS_AS(bench.task.enter(message), core::InternalError);
  CHECK_THROWS_AS(bench.task.resume_hit(message), core::InternalError);
  CHECK_THROWS_AS(bench.next_child(), core::InternalError);
  bench.trace();
  bench.task.shade_hit();
  CHECK_THROWS_AS(bench.task.shade_hit(), core::InternalError);
  RayMessage foreign = message;
  foreign.finder = 9;
  CHECK_THROWS_AS(bench.task.resume_hit(foreign), core::InternalError);
}

TEST_CASE("a ray that starts is traced where it starts in the region, and has left it at once, or missed, where it does not") {
  std::array<std::uint64_t, 4> seen{};
  for (std::uint32_t pixel = 0; pixel < subject().settings().camera.pixel_count(); ++pixel) {
    const core::Ray ray = subject().settings().camera.primary_ray(pixel, 0);
    const auto message = starting(ray);
    Bench shot(half(0)), entered(half(0));
    shot.task.shoot(ray);
    const core::Traced traced = shot.trace();
    ++seen[static_cast<std::size_t>(traced)];
    if (!message) {
      CHECK(traced == core::Traced::miss);
    } else if (!half(0).contains(message->cell)) {
      CHECK(traced == core::Traced::left);
      CHECK(shot.task.leaving().cell == message->cell);
      CHECK(shot.task.leaving().t_enter == message->t_enter);
      CHECK(shot.task.leaving().entry_axis == message->entry_axis);
    } else {
      entered.task.enter(*message);
      CHECK(traced == entered.trace());
      CHECK(shot.task.leaving().t_enter == entered.task.leaving().t_enter);
    }
  }
  CHECK(seen[static_cast<std::size_t>(core::Traced::hit)] > 0);
  CHECK(seen[static_cast<std::size_t>(core::Traced::left)] > 0);
}

}  // namespace ray_task_test
