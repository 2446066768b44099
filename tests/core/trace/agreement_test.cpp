// One answer whatever the way to it: any or nearest hit, with and without skipping, interrupted or not, over pages of any size.
#include <doctest/doctest.h>

#include <cmath>

#include "apps/lab/bench/stability/crowd.h"
#include "apps/lab/bench/stability/random.h"
#include "apps/lab/bench/stability/rays.h"
#include "core/families/scenes.h"
#include "tests/support/scaled.h"
#include "tests/support/shooting.h"

namespace agreement_test {

using namespace dmpc::core;
using namespace dmpc::apps;
using namespace dmpc::tests;

namespace {

Hit shoot_interrupted(const Database& database, const Ray& ray, Operations& operations, std::size_t& interruptions) {
  OneRecord records(database.bytes());
  Cursor cursor;
  while (trace(ray, cursor, records, database.header(), {}, operations) == Traced::absent) {
    records.fetch(cursor.absent);
    ++interruptions;
  }
  return cursor.best;
}

Ray as_shadow(Ray ray, double t_max) {
  ray.kind = RayKind::shadow;
  ray.t_max = static_cast<float>(t_max);
  return ray;
}

}  // namespace

TEST_CASE("a shadow ray is blocked exactly where the nearest hit lies before the light") {
  const Database database = database_of(mixed_scene());
  Random random(1);
  std::size_t differences = 0, hits = 0;
  for (std::size_t i = 0; i < scaled(100'000); ++i) {
    Ray ray = i % 2 == 0 ? random_ray(database, random) : grazing_ray(database, random);
    ray.t_max = static_cast<float>(random.between(0.01, 1.0));
    const bool nearest = shoot(database, ray).found();
    differences += nearest == shoot(database, as_shadow(ray, double{ray.t_max})).found() ? 0 : 1;
    hits += nearest ? 1 : 0;
  }
  CHECK(differences == 0);
  CHECK(hits > 0);
}

TEST_CASE("a hit counts before t_max and not at it") {
  const Database database = database_of(mixed_scene());
  Random random(2);
  for (std::size_t i = 0; i < scaled(2000); ++i) {
    Ray ray = random_ray(database, random);
    const Hit hit = shoot(database, ray);
    if (!hit.found()) {
      continue;
    }
    ray.t_max = hit.t;
    CHECK_FALSE(shoot(database, ray).found());
    ray.t_max = std::nextafter(hit.t, 1e30F);
    CHECK(same_hit(shoot(database, ray), hit));
  }
}

TEST_CASE("a traversal interrupted at every record gives the bits of one that is not, and counts its work") {
  const Database database = database_of(mixed_scene());
  Random random(3);
  Operations once, often;
  LocalRecords all(database.bytes());
  std::size_t differences = 0, interruptions = 0;
  for (std::size_t i = 0; i < scaled(50'000); ++i) {
    const Ray ray = i % 2 == 0 ? random_ray(database, random) : grazing_ray(database, random);
    Cursor cursor;
    trace(ray, cursor, all, database.header(), {}, once);
    differences += same_hit(shoot_interrupted(database, ray, often, interruptions), cursor.best) ? 0 : 1;
  }
  CHECK(differences == 0);
  CHECK(interruptions > scaled(50'000));
  check_same_traversal(once, often);
}

TEST_CASE("pages of every size hold the same hits") {
  const Scene scene = mixed_scene();
  const Database expected = database_of(scene);
  for (std::size_t page_size = 512; page_size <= 65536; page_size *= 2) {
    CAPTURE(page_size);
    BuildOptions options = several_macro_cells(scene);
    options.page_size_bytes = page_size;
    const Database database = build_database(scene, options);
    Random random(7);
    std::size_t differences = 0;
    for (std::size_t i = 0; i < scaled(5000); ++i) {
      const Ray ray = random_ray(expected, random);
      differences += same_hit(shoot(database, ray), shoot(expected, ray)) ? 0 : 1;
    }
    CHECK(differences == 0);
  }
}

}  // namespace agreement_test
