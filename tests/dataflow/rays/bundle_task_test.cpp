#include "dataflow/rays/bundle_task.h"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "tests/dataflow/part_bench.h"

namespace rays_bundle_task_test {

using namespace dmpc;
using dataflow::BundleTask;
using dataflow::RayMessage;
using dataflow::RayTask;
using tests::elsewhere;
using tests::half;
using tests::other;
using tests::self;
using tests::Subject;
using tests::whole;

namespace {

const Subject& subject() { return tests::part_subject(); }

template <class Task>
struct BenchOf : tests::PartBench<Task> {
  using tests::PartBench<Task>::PartBench;

  void trace() { this->task.trace(this->tracer, this->part.header, this->operations); }
  std::vector<core::Ray> next_children() {
    std::vector<core::Ray> children;
    const auto shoot = [&](const auto& make) {
      if (const core::Ray* const child = this->task.shoot_made(make)) {
        children.push_back(*child);
      }
    };
    this->task.next_children(this->tracer, this->settings, this->operations, shoot, tests::no_shine);
    return children;
  }
};
using Bench = BenchOf<BundleTask>;
using Lone = BenchOf<RayTask>;

core::Ray primary(std::uint32_t pixel) { return subject().settings().camera.primary_ray(pixel, 0); }

bool same(const RayMessage& a, const RayMessage& b) {
  return a.ray.pixel == b.ray.pixel && a.t_enter == b.t_enter && a.cell == b.cell && a.entry_axis == b.entry_axis &&
         a.is_confirmed == b.is_confirmed && a.finder == b.finder && a.best.t == b.best.t &&
         a.best.primitive == b.best.primitive && a.best.leaf == b.best.leaf && a.best.lane == b.best.lane;
}

/// The ray that has ended next in a bundle is what a task of its own makes of it.
void check_like(const BundleTask& task, const Lone& lone) {
  REQUIRE(task.traced() == lone.task.traced());
  if (task.traced() == core::Traced::left) {
    CHECK(same(task.leaving(), lone.task.leaving()));
  } else if (task.traced() == core::Traced::hit) {
    CHECK(task.found_here() == lone.task.found_here());
    if (!task.found_here()) {
      CHECK(same(task.confirmed_hit(), lone.task.confirmed_hit()));
    }
  }
}

}  // namespace

TEST_CASE("a bundle's task takes exactly the memory that it has named, and starts with nothing under way") {
  const Bench bench(whole());
  CHECK(bench.memory.used().bytes == nodes::MemoryPlan(BundleTask::layout(5)).bytes);
  CHECK(bench.task.is_idle());
  CHECK(!bench.task.has_rays());
}

TEST_CASE("rays traced together end, or leave for elsewhere, as in a task of their own, and go on so in the next region") {
  std::array<std::uint64_t, 4> seen{};
  for (std::uint32_t first = 0; first < 256; first += 16) {
    Bench here(half(0)), there(half(1));
    for (std::uint32_t i = 0; i < 16; ++i) {
      here.task.shoot(primary(first + i));
    }
    here.trace();
    for (std::uint32_t i = 0; i < 16; ++i, here.task.drop_ended()) {
      Lone lone(half(0));
      lone.task.shoot(primary(first + i));
      lone.trace();
      check_like(here.task, lone);
      ++seen[static_cast<std::size_t>(here.task.traced())];
      if (here.task.traced() == core::Traced::left && half(1).contains(here.task.leaving().cell)) {
        there.task.enter(here.task.leaving());
      }
    }
    CHECK(here.task.is_idle());
    if (!there.task.has_rays()) {
      continue;
    }
    there.trace();
    for (; there.task.has_ended(); there.task.drop_ended()) {
      ++seen[static_cast<std::size_t>(there.task.traced())];
    }
  }
  for (const core::Traced traced : {core::Traced::hit, core::Traced::miss, core::Traced::left}) {
    CHECK(seen[static_cast<std::size_t>(traced)] > 0);
  }
}

TEST_CASE("a candidate of another node's stays its finder's until it is met here, in a bundle as alone") {
  std::uint64_t met = 0, kept = 0;
  for (std::uint32_t first = 0; first < 256; first += 16) {
    Bench bench(whole());
    std::vector<RayMessage> messages;
    for (std::uint32_t pixel = first; pixel < first + 16; ++pixel) {
      const auto passage = core::first_passage(primary(pixel), subject().settings().header.frame);
      Lone finder(whole());
      finder.task.shoot(primary(pixel));
      finder.trace();
      if (!passage || finder.task.traced() != core::Traced::hit) {
        continue;
      }
      RayMessage message = dataflow::message_of(primary(pixel), *passage, other);
      message.best = finder.task.leaving().best;
      message.best.leaf = elsewhere;
      message.best.primitive += pixel % 2 == 0 ? 0 : 0x00ff0000;  // of no primitive that there is
      message.best.t = pixel % 4 < 2 ? message.best.t : static_cast<float>(passage->t_enter) + 1e-6F;
      messages.push_back(message);
      bench.task.enter(message);
    }
    if (messages.empty()) {
      continue;
    }
    bench.trace();
    for (const RayMessage& message : messages) {
      Lone lone(whole());
      lone.task.enter(message);
      lone.trace();
      check_like(bench.task, lone);
      (bench.task.found_here() ? met : kept) += 1;
      bench.task.drop_ended();
    }
  }
  CHECK(met > 10);
  CHECK(kept > 10);
}

TEST_CASE("bundles over the whole scene shoot every ray of the reference renderer, depth first on a stack of hits a depth") {
  Bench bench(whole());
  std::array<std::uint64_t, core::ray_kind_count> rays{};
  for (std::uint32_t first = 0; first < 256; first += 16) {
    for (std::uint32_t i = 0; i < 16; ++i) {
      bench.task.shoot(primary(first + i));
    }
    rays[0] += 16;
    do {
      bench.trace();
      for (; bench.task.has_ended(); bench.task.drop_ended()) {
        if (bench.task.traced() == core::Traced::hit && bench.task.ray().kind != core::RayKind::shadow) {
          bench.task.shade_hit();
        }
      }
      for (const core::Ray& child : bench.next_children()) {
        ++rays[static_cast<std::size_t>(child.kind)];
      }
    } while (bench.task.has_rays());
    CHECK(bench.task.is_idle());
  }
  CHECK(rays == subject().outcome().rays);
  CHECK(bench.operations.shadings == subject().outcome().shadings);
  CHECK(bench.operations.rays_in_bundles > 4 * bench.operations.bundles);
}

TEST_CASE("a ray that has been seen to may enter this region, and is traced with others of its kind") {
  Bench bench(half(0));
  for (std::uint32_t i = 0; i < 16; ++i) {
    bench.task.shoot(primary(128 + i));
  }
  bench.trace();
  std::vector<RayMessage> back;
  for (std::uint32_t i = 0; i < 16; ++i) {
    const core::Ray ray = bench.task.ray();
    bench.task.drop_ended();
    const auto passage = core::first_passage(ray, bench.part.header.frame);
    if (passage && half(0).contains(passage->cell)) {
      back.push_back(dataflow::message_of(ray, *passage, self));
      bench.task.enter(back.back());
    }
  }
  REQUIRE(!back.empty());
  bench.trace();
  for (const RayMessage& message : back) {
    Lone lone(half(0));
    lone.task.enter(message);
    lone.trace();
    CHECK(bench.task.ray().pixel == message.ray.pixel);
    check_like(bench.task, lone);
    bench.task.drop_ended();
  }
  CHECK_FALSE(bench.task.has_ended());
}

TEST_CASE("a bundle's task refuses a seventeenth ray, another finder's hit, and hits too deep for its stack") {
  Bench bench(whole(), 1);
  for (std::uint32_t i = 0; i < 16; ++i) {
    bench.task.shoot(primary(128 + i));
  }
  CHECK_THROWS_AS(bench.task.shoot(primary(0)), core::InternalError);
  CHECK_THROWS_AS(bench.next_children(), core::InternalError);
  bench.trace();
  CHECK_THROWS_AS(bench.task.shoot(primary(0)), core::InternalError);
  CHECK_THROWS_AS(bench.trace(), core::InternalError);
  const auto passage = core::first_passage(primary(128), bench.part.header.frame);
  RayMessage foreign = dataflow::message_of(primary(128), passage.value_or(core::Passage{}), other);
  CHECK_THROWS_AS(bench.task.enter(foreign), core::InternalError);
  CHECK_THROWS_AS(bench.task.resume_hit(foreign), core::InternalError);
}

}  // namespace rays_bundle_task_test
