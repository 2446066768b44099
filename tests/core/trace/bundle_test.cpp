// Rays that walk together hit what each of them hits alone, to the bit.
#include "core/trace/bundle.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/database/extract.h"
#include "core/trace/bundle_traversal.h"
#include "tests/support/covering_faces.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"
#include "tests/support/small_scenes.h"

namespace bundle_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

using BundleRays = std::vector<Ray>;

/// In memory that is not a number, as it may be before.
std::unique_ptr<RayBundle> bundle_of(const BundleRays& rays) {
  auto bundle = std::make_unique<RayBundle>();
  std::memset(static_cast<void*>(bundle.get()), 0xff, sizeof(RayBundle));
  std::copy(rays.begin(), rays.end(), bundle->rays.begin());
  bundle->count = static_cast<std::uint32_t>(rays.size());
  bundle->start();
  return bundle;
}

/// Neighbours: from near one place, to near another; or from there in all directions.
BundleRays neighbours(Random& random, const Database& database, std::uint32_t count, RayKind kind) {
  const auto& primitives = database.primitives();
  const Vec3d origin = random.in_box(-0.2, 1.2),
              target = primitives[random.below(static_cast<std::uint32_t>(primitives.size()))].vector(0);
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

/// The hits are those of rays that walk alone; for shadow rays any hit will do.
void check_hits(const RayBundle& bundle, const WalksAlone& expected) {
  for (std::size_t i = 0; i < bundle.count; ++i) {
    CAPTURE(i);
    CHECK(((bundle.found >> i & 1U) != 0) == expected.hits[i].found());
    if (!bundle.any) {
      CHECK(same_hit(bundle.best.of(i), expected.hits[i]));
      CHECK(bundle.best.of(i).leaf == expected.hits[i].leaf);
    }
  }
}

/// Scenes of triangles alone, of all kinds of primitives, and with empty space between its parts.
const std::vector<Database>& bundle_subjects() {
  static const std::vector<Database> all = [] {
    std::vector<Database> result;
    for (const auto& scene : {built_in("teapot-3"), everything(), built_in("tetra-4"), built_in("balls-1"),
                              rug_on_floor(true, true, 6), glass_on_floor(false, true)}) {
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
      CHECK(BundleTraversal<LocalRecords>(*bundle, records, database.header(), {}, operations, *steps, *intersectors).run());
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
      BundleTraversal<LocalRecords>(*one, records, database.header(), {}, fast).run();
      BundleTraversal<LocalRecords>(*other, records, database.header(), {}, slow, *bundle_steps(set), *bundle_intersectors(set))
          .run();
      check_same_traversal(fast, slow);
      CHECK(fast.skipped.bundles == slow.skipped.bundles);
      CHECK(fast.skipped.any_hit == slow.skipped.any_hit);
    });
  }
}

TEST_CASE("children that wait for shadow rays with a hit are counted child by child and ray by ray, whatever instructions") {
  Random random(78);
  for (std::size_t set = 0; bundle_intersectors(set) != nullptr; ++set) {
    auto bundle = std::make_unique<RayBundle>();
    for (std::size_t turn = 0; turn < 200; ++turn) {
      const RayMask hit = random.below(1U << bundle_rays_max);
      int saved = 0;
      bundle->waiting.count = random.below(9);
      for (std::size_t child = 0; child < bundle->waiting.count; ++child) {
        bundle->waiting.rays[child] = random.below(1U << bundle_rays_max);
        saved += std::popcount(bundle->waiting.rays[child] & hit);
      }
      CHECK(bundle_intersectors(set)->count_waiting(*bundle, hit) == static_cast<std::uint64_t>(saved));
    }
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
    check_same_traversal(at_once, in_steps);
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
    check_same_traversal(operations, expected.operations);
    CHECK(operations.empty_cells == expected.operations.empty_cells);
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
  CHECK(operations.bvh_node_reads == 16 * one.bvh_node_reads);
  CHECK(operations.cell_steps == 16 * one.cell_steps);
  CHECK(operations.bundles == 1);
  CHECK(operations.rays_in_bundles == 16);
  CHECK(operations.skipped.bundles % 15 == 0);
  CHECK(operations.skipped.bundles >= 15 * one.bvh_node_reads);
}

TEST_CASE("without skips a bundle finds the nearest hits of shadow rays") {
  for_some_bundles(76, 400, [](const Database& database, const BundleRays& rays) {
    const Skips none = no_skips();
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of(rays);
    trace(*bundle, records, database.header(), none, operations);
    CHECK_FALSE(bundle->any);
    check_hits(*bundle, walk_alone(database, rays, none));
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

namespace {

/// A ray on its way from region to region.
struct Traveller {
  Ray ray;
  std::optional<Passage> passage;  ///< none: it starts
  Traced traced = Traced::left;
};

/// What a traversal alone makes of it in the region of `part`.
Traveller walk_on(const Traveller& traveller, const DatabasePart& part, Operations& operations) {
  Traveller next = traveller;
  next.passage = traveller.passage ? traveller.passage : first_passage(traveller.ray, part.header.frame);
  next.traced = next.passage ? Traced::left : Traced::miss;
  if (next.passage && part.header.region.contains(next.passage->cell)) {
    Cursor cursor = arrive(*next.passage);
    LocalRecords records(part.bytes);
    next.traced = trace(traveller.ray, cursor, records, part.header, {}, operations);
    next.passage = passage_of(cursor);
  }
  return next;
}

void check_same_way(const RayBundle& bundle, std::size_t ray, const Traveller& expected) {
  const RayMask bit = RayMask{1} << ray;
  CHECK(((bundle.left & bit) != 0) == (expected.traced == Traced::left));
  if (expected.traced == Traced::left) {
    const Passage passage = bundle.passage(ray);
    CHECK(std::bit_cast<std::uint64_t>(passage.t_enter) == std::bit_cast<std::uint64_t>(expected.passage->t_enter));
    CHECK(passage.cell == expected.passage->cell);
    CHECK(passage.entry_axis == expected.passage->entry_axis);
  } else {
    CHECK(((bundle.found & bit) != 0) == (expected.traced == Traced::hit));
  }
  if (expected.traced != Traced::miss && !bundle.any) {
    CHECK(same_hit(bundle.hit(ray), expected.passage->best));
    CHECK(bundle.hit(ray).leaf == expected.passage->best.leaf);
  }
}

/// The grid cut in two by planes of two axes, anywhere.
std::vector<DatabasePart> random_parts(Random& random, const Database& database) {
  const Corner size = grid_size(database.header().frame);
  const std::size_t axis = random.below(3), other = (axis + 1 + random.below(2)) % 3;
  std::vector<DatabasePart> parts;
  Region low{.high = size}, high{.high = size}, highest{.high = size};
  low.high[axis] = high.low[axis] = highest.low[axis] =
      1 + static_cast<std::int32_t>(random.below(static_cast<std::size_t>(size[axis] - 1)));
  high.high[other] = highest.low[other] = 1 + static_cast<std::int32_t>(random.below(static_cast<std::size_t>(size[other] - 1)));
  for (const Region& region : {low, high, highest}) {
    parts.push_back(extract(database, region));
  }
  return parts;
}

/// Walks those that are, or start, in the part's region together, and each alone: both come to the same.
void walk_on_together(std::vector<Traveller>& all, const DatabasePart& part, const BundleSteps& steps,
                      const BundleIntersectors& intersectors) {
  std::vector<Traveller*> here;
  BundleRays rays;
  for (Traveller& traveller : all) {
    if (traveller.traced == Traced::left && (!traveller.passage || part.header.region.contains(traveller.passage->cell))) {
      here.push_back(&traveller);
      rays.push_back(traveller.ray);
    }
  }
  if (here.empty()) {
    return;
  }
  const auto bundle = bundle_of(rays);
  for (std::size_t i = 0; i < here.size(); ++i) {
    if (here[i]->passage) {
      here[i]->passage->best.leaf = no_address;  // it was read elsewhere
      bundle->arrive(i, *here[i]->passage);
    }
  }
  LocalRecords records(part.bytes);
  Operations together, alone;
  CHECK(BundleTraversal<LocalRecords>(*bundle, records, part.header, {}, together, steps, intersectors).run());
  for (std::size_t i = 0; i < here.size(); ++i) {
    CAPTURE(i);
    *here[i] = walk_on(*here[i], part, alone);
    check_same_way(*bundle, i, *here[i]);
  }
  if (here.size() == 1) {
    check_same_traversal(together, alone);
  }
}

}  // namespace

TEST_CASE("rays that walk together leave a region where and as they do alone, and go on so in the next, whatever instructions") {
  std::size_t sets = 0;
  for (const BundleSteps* steps = nullptr; (steps = bundle_steps(sets)) != nullptr; ++sets) {
    CAPTURE(sets);
    std::size_t hops = 0, hits = 0;
    Random random(78);
    std::vector<DatabasePart> parts;
    const Database* cut = nullptr;
    for_some_bundles(79, 1200, [&](const Database& database, const BundleRays& rays) {
      if (&database != cut || random.below(8) == 0) {
        parts = random_parts(random, database);
        cut = &database;
      }
      std::vector<Traveller> travellers;
      for (const Ray& ray : rays) {
        travellers.push_back({ray, std::nullopt});
      }
      for (std::size_t round = 0; round < 3 * parts.size(); ++round) {
        walk_on_together(travellers, parts[round % parts.size()], *steps, *bundle_intersectors(sets));
      }
      for (const Traveller& traveller : travellers) {
        CHECK(traveller.traced != Traced::left);
        hops += traveller.passage && traveller.passage->entry_axis != traversal_starts ? 1 : 0;
        hits += traveller.traced == Traced::hit ? 1 : 0;
      }
    });
    CHECK(hops > 20);
    CHECK(hits > 100);
  }
}

TEST_CASE("a candidate that was read elsewhere gives way to the same hit read here, and to no other that is not nearer") {
  RayBundle bundle;
  bundle.start();
  const Hit candidate{2.0F, 7};
  bundle.arrive(3, {.best = candidate});
  CHECK(bundle.hit(3).primitive == 7);
  CHECK(bundle.hit(3).leaf == no_address);
  CHECK(nearer(2.0F, 7, bundle.best.of(3)));
  CHECK_FALSE(nearer(2.0F, 8, bundle.best.of(3)));
  CHECK_FALSE(replaces(2.0F, 8, bundle.best.of(3)));
  bundle.arrive(4, {});
  CHECK_FALSE(bundle.hit(4).found());
}

TEST_CASE("a hit that is nearer than a candidate read elsewhere takes its place, be its id the next one") {
  std::uint64_t hits = 0;
  for_some_bundles(80, 400, [&](const Database& database, const BundleRays& rays) {
    const Ray& ray = rays[0];
    const Hit hit = walk_alone(database, {ray}, no_skips()).hits[0];
    const auto passage = first_passage(ray, database.header().frame);
    if (!hit.found() || hit.primitive == 0 || !passage) {
      return;
    }
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of({ray});
    bundle->arrive(0, {passage->t_enter, passage->cell, passage->entry_axis, {hit.t + 1, hit.primitive - 1}});
    trace(*bundle, records, database.header(), no_skips(), operations);
    CHECK(same_hit(bundle->hit(0), hit));
    CHECK(bundle->hit(0).leaf == hit.leaf);
    ++hits;
  });
  CHECK(hits > 5);
}

TEST_CASE("rays that come from elsewhere walk together with rays that start") {
  for_some_bundles(81, 1000, [](const Database& database, const BundleRays& rays) {
    LocalRecords records(database.bytes());
    Operations operations;
    const auto bundle = bundle_of(rays);
    for (std::size_t i = 1; i < rays.size(); i += 3) {
      if (const auto passage = first_passage(rays[i], database.header().frame)) {
        bundle->arrive(i, *passage);
      }
    }
    trace(*bundle, records, database.header(), {}, operations);
    check_hits(*bundle, walk_alone(database, rays));
  });
}

TEST_CASE("rays pass boxes of their own together as each does alone, whatever instructions the processor has") {
  for (std::size_t set = 0; bundle_steps(set) != nullptr; ++set) {
    CAPTURE(set);
    Random random(79);
    std::uint64_t passed = 0;
    for_some_bundles(80, 1000, [&](const Database& database, const BundleRays& rays) {
      const DatabaseHeader& header = database.header();
      const Corner size = grid_size(header.frame);
      const auto bundle = bundle_of(rays);
      bundle_steps(set)->enter(*bundle, header.frame, Region{});  // all that meet the grid have left that region
      const RayMask all = bundle->left;
      Row<Region> boxes;
      alignas(64) PlaneRows planes{};
      std::vector<Passage> before;
      for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        bundle->best.t[ray] = random.below(4) == 0 ? static_cast<float>(random.between(0, 2)) : bundle->best.t[ray];
        before.push_back(bundle->passage(ray));
        for (std::size_t axis = 0; axis < 3 && (all >> ray & 1U) != 0; ++axis) {
          const std::int32_t cell = before[ray].cell[axis];
          boxes[ray].low[axis] = cell - static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(cell + 1)));
          boxes[ray].high[axis] =
              cell + 1 + static_cast<std::int32_t>(random.below(static_cast<std::uint32_t>(size[axis] - cell)));
          const bool is_forward = (bundle->forward[axis] >> ray & 1U) != 0;
          planes[axis][ray] = is_forward ? boxes[ray].high[axis] : boxes[ray].low[axis];
        }
      }
      bundle_steps(set)->find_box_exits(*bundle, all, planes);
      const RayMask on = bundle_steps(set)->pass_boxes(*bundle, all, planes);
      CHECK((on & ~all) == 0);
      for (std::size_t ray = 0; ray < rays.size(); ++ray) {
        if ((all >> ray & 1U) == 0) {
          continue;
        }
        Passage expected = before[ray];
        Operations operations;
        const Traced traced = pass(rays[ray], header.frame, boxes[ray], expected, operations);
        CHECK(((on >> ray & 1U) != 0) == (traced == Traced::left));
        const Passage passage = bundle->passage(ray);
        CHECK(std::bit_cast<std::uint64_t>(passage.t_enter) == std::bit_cast<std::uint64_t>(expected.t_enter));
        CHECK(passage.cell == expected.cell);
        CHECK(passage.entry_axis == expected.entry_axis);
        passed += traced == Traced::left ? 1 : 0;
      }
    });
    CHECK(passed > 300);
  }
}

}  // namespace bundle_test
