#include "core/traversal.h"

#include <doctest/doctest.h>

#include "tests/support/mesh.h"
#include "tests/support/shooting.h"

using namespace dmpc::core;
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

TEST_CASE("a walk that has ended answers again and reads nothing more") {
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
