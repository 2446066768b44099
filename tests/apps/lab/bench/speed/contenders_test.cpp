// The contenders of `bench speed`: Embree as a baseline, a pager with all pages, threads.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/lab/bench/speed/crew.h"
#include "apps/lab/bench/speed/embree_tree.h"
#include "apps/lab/bench/speed/kernel_arena.h"
#include "apps/lab/bench/speed/recording.h"
#include "apps/lab/bench/speed/warm_pager.h"
#include "tests/support/small_subject.h"

namespace dmpc::tests::contenders_test {

using apps::Contender;
using apps::EmbreeMode;
using apps::EmbreeTree;
using apps::Query;
using apps::RayClass;

namespace {

template <core::Records R>
std::uint64_t hits_of(const std::vector<core::Ray>& rays, R& records, const core::DatabaseHeader& header) {
  core::GridTracer<R> tracer(records, header, {});
  core::Operations operations;
  return static_cast<std::uint64_t>(std::count_if(rays.begin(), rays.end(), [&](const core::Ray& ray) {
    core::Cursor cursor;
    return tracer.trace(ray, cursor, operations) == core::Traced::hit;
  }));
}

}  // namespace

TEST_CASE("the baseline hits as many primary rays as our grid, triangles and spheres, closest and any") {
  for (const char* scene : {"tetra-3", "balls-2"}) {
    CAPTURE(std::string(scene));
    const apps::Subject subject = small_subject(scene, {32, 32});
    const auto rays = apps::record_rays(subject.database, subject.settings, 10'000).of(apps::RayClass::primary).rays;
    core::LocalRecords records(subject.database.bytes());
    const std::uint64_t hits = hits_of(rays, records, subject.settings.header);
    REQUIRE(hits > 100);
    for (const EmbreeMode mode : {EmbreeMode::robust, EmbreeMode::fast}) {
      const EmbreeTree baseline(subject.database.primitives(), mode);
      CHECK(baseline.trace(rays, Query::closest) == hits);
      CHECK(baseline.trace(rays, Query::any) == hits);
      CHECK(baseline.trace({}, Query::any) == 0);
      CHECK(baseline.build_times().wall_seconds > 0);
    }
  }
}

TEST_CASE("all contenders hit about as much of every class, ours the same") {
  apps::SpeedSettings settings;
  settings.is_quick = true;
  settings.resolution = apps::Resolution{32, 32};
  settings.thread_counts = {1, 2};
  apps::KernelArena arena("balls-2", settings);
  for (const RayClass ray_class : {RayClass::primary, RayClass::shadow, RayClass::secondary, RayClass::bounce}) {
    CAPTURE(std::string(name_of(ray_class)));
    const std::uint64_t hits = arena.trace(Contender::grid, ray_class, Query::closest, 1).hits;
    CHECK(hits > 0);
    for (const Contender ours : {Contender::paged_grid, Contender::bundles, Contender::paged_bundles}) {
      CHECK(arena.trace(ours, ray_class, Query::closest, 1).hits == hits);
      CHECK(arena.trace(ours, ray_class, Query::any, 2).hits == hits);
    }
    for (const Contender baseline : {Contender::robust, Contender::fast}) {
      const auto its = static_cast<double>(arena.trace(baseline, ray_class, Query::closest, 2).hits);
      CHECK(its == doctest::Approx(static_cast<double>(hits)).epsilon(0.02));
    }
  }
}

TEST_CASE("the baseline looks no farther than a ray goes") {
  const apps::Subject subject = small_subject("balls-2", {32, 32});
  auto rays = apps::record_rays(subject.database, subject.settings, 10'000).of(apps::RayClass::primary).rays;
  for (core::Ray& ray : rays) {
    ray.t_max = 1e-3F;
  }
  const EmbreeTree baseline(subject.database.primitives(), EmbreeMode::robust);
  CHECK(baseline.trace(rays, Query::closest) == 0);
  CHECK(baseline.trace(rays, Query::any) == 0);
}

TEST_CASE("a warm pager lacks no page, and has all but its own in the cache") {
  const apps::Subject subject = small_subject("tetra-3", {32, 32});
  apps::WarmPager warm(subject.database, subject.settings, 4);
  const svm::PageCounters before = warm.pager().counters();
  CHECK(before.faults == subject.database.page_count() - (subject.database.page_count() + 3) / 4);
  CHECK(before.evictions == 0);
  const auto rays = apps::record_rays(subject.database, subject.settings, 10'000).of(apps::RayClass::primary).rays;
  core::LocalRecords records(subject.database.bytes());
  CHECK(hits_of(rays, warm.pager(), subject.settings.header) == hits_of(rays, records, subject.settings.header));
  const svm::PageCounters after = warm.pager().counters();
  CHECK(after.misses == before.misses);
  CHECK(after.cache_hits > before.cache_hits);
  CHECK(after.home_hits > before.home_hits);
}

TEST_CASE("an exception on a crew's thread comes back when all are over") {
  std::atomic<int> others = 0;
  const auto work = [&](std::size_t index) {
    if (index == 0) {
      throw std::runtime_error("share 0");
    }
    ++others;
  };
  CHECK_THROWS_AS(apps::on_threads(3, work), std::runtime_error);
  CHECK(others == 2);
}

}  // namespace dmpc::tests::contenders_test
