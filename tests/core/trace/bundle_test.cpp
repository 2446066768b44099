// Rays that walk together hit what each of them hits alone, to the bit.
#include "core/trace/bundle.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <limits>
#include <memory>
#include <vector>

#include "apps/bench/stability/random.h"
#include "apps/bench/stability/records.h"
#include "core/trace/bundle_walk.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

using BundleRays = std::vector<Ray>;

std::unique_ptr<RayBundle> bundle_of(const BundleRays& rays) {
  auto bundle = std::make_unique<RayBundle>();
  std::copy(rays.begin(), rays.end(), bundle->rays.begin());
  bundle->count = static_cast<std::uint32_t>(rays.size());
  bundle->start();
  return bundle;
}

/// Neighbours: from near one place, to near another; or from there in all directions.
BundleRays neighbours(Random& random, const Database& database, std::uint32_t count, RayKind kind) {
  const auto& primitives = database.primitives();
  const Vec3d origin = random.in_box(-0.2, 1.2),
              target = point_of(primitives[random.below(static_cast<std::uint32_t>(primitives.size()))], 0);
  const double spread = std::array{0.0, 1e-3, 0.05, 1.0}[random.below(4)];
  BundleRays rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    Ray ray = ray_through(origin + random.in_box(-0.01, 0.01), target + random.in_box(-1, 1) * spread);
    ray.kind = kind;
    ray.t_max = random.below(3) == 0 ? static_cast<float>(random.between(0, 2)) : std::numeric_limits<float>::infinity();
    ray.ignored_primitive = random.below(3) == 0 ? random.below(static_cast<std::uint32_t>(primitives.size())) : no_primitive;
    rays.push_back(ray);
  }
  return rays;
}

struct WalksAlone {
  std::vector<Hit> hits;
  Operations operations;
};

WalksAlone walk_alone(const Database& database, const BundleRays& rays, const Skips& skips = {}) {
  WalksAlone result;
  LocalRecords records(database.bytes());
  for (const Ray& ray : rays) {
    Cursor cursor;
    trace(ray, cursor, records, database.header(), skips, result.operations);
    result.hits.push_back(cursor.best);
  }
  return result;
}

/// Of shadow rays any hit will do.
void check_hits(const RayBundle& bundle, const WalksAlone& expected) {
  for (std::size_t i = 0; i < bundle.count; ++i) {
    CAPTURE(i);
    CHECK(((bundle.found >> i & 1U) != 0) == expected.hits[i].found());
    if (!bundle.any) {
      CHECK(same_hit(bundle.best.of(i), expected.hits[i]));
      CHECK(bundle.best.of(i).block == expected.hits[i].block);
    }
  }
}

/// Of triangles alone, of all kinds of primitives, and with empty space between its parts.
const std::vector<Database>& bundle_subjects() {
  static const std::vector<Database> all = [] {
    std::vector<Database> result;
    for (const auto& scene : {built_in("teapot-3"), everything(), built_in("tetra-4"), built_in("balls-1")}) {
      result.push_back(database_of(scene));
    }
    return result;
  }();
  return all;
}

template <class Check>
void for_some_bundles(std::uint64_t seed, std::size_t count, const Check& check) {
  Random random(seed);
  for (std::size_t turn = 0; turn < ray_count(count); ++turn) {
    const Database& database = bundle_subjects()[turn % bundle_subjects().size()];
    const RayKind kind = random.below(2) == 0 ? RayKind::primary : RayKind::shadow;
    const BundleRays rays = neighbours(random, database, random.below(bundle_rays_max) + 1, kind);
    CAPTURE(turn);
    check(database, rays);
  }
}

}  // namespace

TEST_CASE("rays are counted as their bits are") {
  for (RayMask rays = 0; rays < 1U << bundle_rays_max; ++rays) {
    if (count_of(rays) != static_cast<std::uint32_t>(std::popcount(rays))) {
      FAIL(rays);
    }
  }
}

TEST_CASE("1 to 16 rays that walk together hit what they hit alone, whatever instructions the processor has") {
  std::size_t sets = 0;
  for (const BundleSteps* steps = nullptr; (steps = bundle_steps(sets)) != nullptr; ++sets) {
    const BundleIntersectors* const intersectors = bundle_intersectors(sets);
    REQUIRE(intersectors != nullptr);
    CAPTURE(sets);
    std::uint64_t hits = 0;
    for_some_bundles(71, 4000, [&](const Database& database, const BundleRays& rays) {
      LocalRecords records(database.bytes());
      Operations operations;
      const auto bundle = bundle_of(rays);
      CHECK(BundleWalk<LocalRecords>(*bundle, records, database.header(), {}, operations, *steps, *intersectors).run());
      check_hits(*bundle, walk_alone(database, rays));
      hits += count_of(bundle->found);
    });
    CHECK(hits > 1000);
  }
  CHECK(sets > 0);
  CHECK(bundle_intersectors(sets) == nullptr);
}

TEST_CASE("a bundle does the same work, whatever instructions the processor has") {
  for (std::size_t set = 1; bundle_steps(set) != nullptr; ++set) {
    for_some_bundles(72, 1000, [&](const Database& database, const BundleRays& rays) {
      LocalRecords records(database.bytes());
      Operations fast, slow;
      const auto one = bundle_of(rays), other = bundle_of(rays);
      BundleWalk<LocalRecords>(*one, records, database.header(), {}, fast).run();
      BundleWalk<LocalRecords>(*other, records, database.header(), {}, slow, *bundle_steps(set), *bundle_intersectors(set)).run();
      CHECK(fast.brick_reads == slow.brick_reads);
      CHECK(fast.cell_steps == slow.cell_steps);
      CHECK(fast.primitive_tests == slow.primitive_tests);
      CHECK(fast.skipped.bundles == slow.skipped.bundles);
      CHECK(fast.skipped.any_hit == slow.skipped.any_hit);
    });
  }
}

TEST_CASE("a bundle that waits for every record finds the same and counts the same work") {
  for_some_bundles(73, 400, [](const Database& database, const BundleRays& rays) {
    LocalRecords all(database.bytes());
    OneRecord one(database.bytes());
    Operations at_once, in_steps;
    const auto expected = bundle_of(rays), bundle = bundle_of(rays);
    CHECK(trace(*expected, all, database.header(), {}, at_once));
    std::uint64_t waits = 0;
    for (; !trace(*bundle, one, database.header(), {}, in_steps); ++waits) {
      one.fetch(bundle->absent);
    }
    CHECK(waits >= (bundle->found != 0 ? 1 : 0));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      CHECK(same_hit(bundle->best.of(i), expected->best.of(i)));
    }
    CHECK(at_once.brick_reads == in_steps.brick_reads);
    CHECK(at_once.cell_steps == in_steps.cell_steps);
    CHECK(at_once.primitive_tests == in_steps.primitive_tests);
    CHECK(at_once.skipped.bundles == in_steps.skipped.bundles);
  });
}

TEST_CASE("a bundle of one ray does that ray's work") {
  Random random(74);
  for (std::size_t turn = 0; turn < ray_count(1000); ++turn) {
    const Database& database = bundle_subjects()[turn % bundle_subjects().size()];
    const BundleRays rays = neighbours(random, database, 1, RayKind::primary);
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of(rays);
    trace(*bundle, records, database.header(), {}, operations);
    const WalksAlone expected = walk_alone(database, rays);
    check_hits(*bundle, expected);
    CHECK(operations.brick_reads == expected.operations.brick_reads);
    CHECK(operations.cell_steps == expected.operations.cell_steps);
    CHECK(operations.primitive_tests == expected.operations.primitive_tests);
    CHECK(operations.skipped.empty_space == expected.operations.skipped.empty_space);
    CHECK(operations.bundles == 0);
    CHECK(operations.skipped.bundles == 0);
  }
}

TEST_CASE("sixteen equal rays look each record up once, and are counted as sixteen") {
  const Database& database = bundle_subjects()[0];
  Random random(75);
  const Ray ray = neighbours(random, database, 1, RayKind::primary)[0];
  const BundleRays rays(16, ray);
  LocalRecords records(database.bytes());
  Operations operations;
  const auto bundle = bundle_of(rays);
  trace(*bundle, records, database.header(), {}, operations);
  const Operations one = walk_alone(database, {ray}).operations;
  CHECK(operations.brick_reads == 16 * one.brick_reads);
  CHECK(operations.cell_steps == 16 * one.cell_steps);
  CHECK(operations.bundles == 1);
  CHECK(operations.rays_in_bundles == 16);
  CHECK(operations.skipped.bundles % 15 == 0);
  CHECK(operations.skipped.bundles >= 15 * one.brick_reads);
}

TEST_CASE("without skips a bundle finds the nearest hits of shadow rays, cell by cell") {
  for_some_bundles(76, 400, [](const Database& database, const BundleRays& rays) {
    const Skips none = no_skips();
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of(rays);
    trace(*bundle, records, database.header(), none, operations);
    CHECK_FALSE(bundle->any);
    check_hits(*bundle, walk_alone(database, rays, none));
    CHECK(operations.skipped.empty_space == 0);
    CHECK(operations.skipped.any_hit == 0);
  });
}

TEST_CASE("rays with odd numbers miss or hit as they do alone, and do not disturb their neighbours") {
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();
  constexpr std::array odd{0.0F, -0.0F, nothing, endless, -endless, 3e38F, 1e-40F, -1e-18F, 1.0F, -1.0F, 0.5F};
  Random random(77);
  const auto any_number = [&] { return odd[random.below(odd.size())]; };
  for (std::size_t turn = 0; turn < ray_count(2000); ++turn) {
    const Database& database = bundle_subjects()[turn % bundle_subjects().size()];
    BundleRays rays = neighbours(random, database, 16, RayKind::primary);
    for (std::size_t i = random.below(2); i < rays.size(); i += 2) {
      (random.below(2) == 0 ? rays[i].origin : rays[i].direction)[random.below(3)] = any_number();
    }
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of(rays);
    trace(*bundle, records, database.header(), {}, operations);
    check_hits(*bundle, walk_alone(database, rays));
  }
}
