#include "core/trace/traversal.h"

#include <doctest/doctest.h>

#include <array>

#include "apps/lab/bench/stability/mesh.h"
#include "core/database/extract.h"
#include "tests/support/border_scene.h"
#include "tests/support/shooting.h"

namespace traversal_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

/// Has everything, and counts what is asked for.
struct CountingRecords {
  explicit CountingRecords(const Database& database) : all(database.bytes()) {}
  const std::byte* find(Address address) {
    ++asked;
    return all.find(address);
  }
  LocalRecords all;
  int asked = 0;
};

/// Has nothing.
struct NoRecords {
  const std::byte* find(Address) { return nullptr; }
};

const Database& cube_database() {
  static const Database database = database_of(seen_from(scene_of(cube()), 2));
  return database;
}

Ray ray_in_world(const Vec3d& from, const Vec3d& to) {
  const GridFrame& frame = cube_database().header().frame;
  return ray_through(to_local(frame, from), to_local(frame, to));
}

Traced traced(const Ray& ray, Cursor& cursor, CountingRecords& records) {
  Operations operations;
  return trace(ray, cursor, records, cube_database().header(), {}, operations);
}

}  // namespace

TEST_CASE("a ray beside the grid, away from it or ending before it reads no record") {
  Ray short_ray = ray_in_world({5, 0, 0}, {0, 0, 0});
  short_ray.t_max = 0.1F;
  for (const Ray& ray : {ray_in_world({5, 5, 0}, {5, 6, 0}), ray_in_world({5, 0, 0}, {6, 0, 0}), short_ray}) {
    Cursor cursor;
    CountingRecords records(cube_database());
    CHECK(traced(ray, cursor, records) == Traced::miss);
    CHECK(records.asked == 0);
  }
}

TEST_CASE("a traversal that has ended answers again and reads nothing more") {
  Cursor cursor;
  CountingRecords records(cube_database());
  const Ray ray = ray_in_world({5, 0.1, 0.2}, {0, 0, 0});
  CHECK(traced(ray, cursor, records) == Traced::hit);
  const int asked = records.asked;
  const Hit first = cursor.best;
  CHECK(traced(ray, cursor, records) == Traced::hit);
  CHECK(same_hit(first, cursor.best));
  CHECK(records.asked == asked);
}

TEST_CASE("an absent record is named, and asked for again until it is there") {
  Cursor cursor;
  NoRecords none;
  Operations operations;
  const Ray ray = ray_in_world({5, 0.1, 0.2}, {0, 0, 0});
  const DatabaseHeader& header = cube_database().header();
  for (int i = 0; i < 3; ++i) {
    CHECK(trace(ray, cursor, none, header, {}, operations) == Traced::absent);
    CHECK(cursor.absent != no_address);
  }
  CountingRecords records(cube_database());
  CHECK(traced(ray, cursor, records) == Traced::hit);
}

TEST_CASE("hits come from the near side, at their distance") {
  Cursor cursor;
  CountingRecords records(cube_database());
  CHECK(traced(ray_in_world({5, 0.1, 0.2}, {0, 0.1, 0.2}), cursor, records) == Traced::hit);
  CHECK(double{cursor.best.t} == doctest::Approx(4 * cube_database().header().frame.scale).epsilon(1e-6));
}

TEST_CASE("the ignored primitive is passed") {
  Ray ray = ray_in_world({5, 0.1, 0.2}, {0, 0.1, 0.2});
  const Hit near = shoot(cube_database(), ray);
  ray.ignored_primitive = near.primitive;
  const Hit far = shoot(cube_database(), ray);
  CHECK(double{far.t} == doctest::Approx(6 * cube_database().header().frame.scale).epsilon(1e-6));
}

namespace {

const Database& border_database() {
  static const Database database = build_database(BorderScene().scene(), BorderScene::options());
  return database;
}

/// A coordinate of a plane between cells; exact where `plane` is a power of two.
float coordinate(std::int32_t plane) { return static_cast<float>(plane) * border_database().header().frame.finest_cell; }

/// The cursor after a traversal from `passage` through the part of the grid that is `region`.
struct Stretch {
  Stretch(const Ray& ray, const Passage& passage, const Region& region) : cursor(arrive(passage)) {
    const DatabasePart part = extract(border_database(), region);
    LocalRecords records(part.bytes);
    Operations operations;
    traced = trace(ray, cursor, records, part.header, {}, operations);
  }
  Cursor cursor;
  Traced traced = Traced::miss;
};

Stretch first_stretch(const Ray& ray, const Region& region) {
  return Stretch(ray, *first_passage(ray, border_database().header().frame), region);
}

/// The low or the high half of the grid along each of two axes, the whole along the third.
Region quarter(std::size_t axis, bool high, std::size_t other_axis, bool other_high) {
  constexpr std::int32_t size = BorderScene::size, middle = size / 2;
  Region region{{}, {size, size, size}};
  (high ? region.low : region.high)[axis] = middle;
  (other_high ? region.low : region.high)[other_axis] = middle;
  return region;
}

}  // namespace

TEST_CASE("a hit exactly in the plane in which a ray leaves its region belongs to the region behind, which finds the same") {
  constexpr std::int32_t middle = BorderScene::size / 2;
  const Region low{{}, {middle, BorderScene::size, BorderScene::size}},
      high{{middle, 0, 0}, {BorderScene::size, BorderScene::size, BorderScene::size}};
  int exact = 0;
  for (const bool upwards : {false, true}) {
    for (std::int32_t i = 0; i < 400; ++i) {
      const auto beside = [](std::int32_t step) { return coordinate(BorderScene::planes[0] + 8 + step * 24); };
      const Ray ray = ray_from({coordinate(upwards ? BorderScene::planes[0] : BorderScene::size), beside(i % 20), beside(i / 20)},
                               {upwards ? 1.0F : -1.0F, 0, 0});
      const Hit whole = shoot(border_database(), ray);
      if (double{ray.origin.x} + (upwards ? 1.0 : -1.0) * double{whole.t} != double{coordinate(middle)}) {
        continue;
      }
      ++exact;
      const Stretch first = first_stretch(ray, upwards ? low : high);
      CHECK(first.traced == Traced::left);
      CHECK(same_hit(first.cursor.best, whole));
      CHECK(passage_of(first.cursor).t_enter == double{whole.t});
      const Stretch second(ray, passage_of(first.cursor), upwards ? high : low);
      CHECK(second.traced == Traced::hit);
      CHECK(same_hit(second.cursor.best, whole));
    }
  }
  CHECK(exact > 100);
}

TEST_CASE("a ray through the edge where four regions meet crosses the planes in the order x, y, z") {
  const std::array<std::array<std::size_t, 2>, 3> pairs{{{0, 1}, {0, 2}, {1, 2}}};
  constexpr std::int32_t middle = BorderScene::size / 2;
  for (const auto& [first, second] : pairs) {
    for (const bool upwards : {false, true}) {
      CAPTURE(first);
      CAPTURE(second);
      CAPTURE(upwards);
      Vec3f origin{coordinate(middle / 4), coordinate(middle / 4), coordinate(middle / 4)}, direction;
      origin[first] = origin[second] = coordinate(upwards ? middle - 376 : middle + 376);
      direction[first] = direction[second] = upwards ? 0.7071068F : -0.7071068F;
      const Ray ray = ray_from(origin, direction);
      const Stretch before = first_stretch(ray, quarter(first, !upwards, second, !upwards));
      REQUIRE(before.traced == Traced::left);
      const Passage edge = passage_of(before.cursor);
      CHECK(edge.entry_axis == first);
      CHECK(edge.cell[first] == (upwards ? middle : middle - 1));
      CHECK(edge.cell[second] == (upwards ? middle - 1 : middle));
      const Stretch between(ray, edge, quarter(first, upwards, second, !upwards));
      REQUIRE(between.traced == Traced::left);
      const Passage behind = passage_of(between.cursor);
      CHECK(behind.entry_axis == second);
      CHECK(behind.t_enter == edge.t_enter);
      CHECK(behind.cell[first] == (upwards ? middle : middle - 1));
      CHECK(behind.cell[second] == (upwards ? middle : middle - 1));
    }
  }
}

}  // namespace traversal_test
