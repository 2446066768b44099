#include "core/database/proxy.h"

#include <doctest/doctest.h>

#include <limits>

#include "apps/lab/bench/stability/cells.h"
#include "apps/lab/bench/stability/random.h"
#include "core/database/database.h"
#include "core/record/directory.h"
#include "core/trace/traversal.h"
#include "tests/support/small_scenes.h"

namespace proxy_test {

using namespace dmpc;

namespace {

constexpr float never = std::numeric_limits<float>::infinity();

struct Hat {
  core::Scene scene = tests::built_in("sombrero-1");
  core::Database database = core::build_database(scene, apps::several_macro_cells(scene));
};

float first_leaf(const core::DatabaseHeader& header, std::span<const std::byte> bytes, const core::Ray& ray,
                 const core::Passage& start, core::Operations& operations) {
  core::LocalRecords records(bytes);
  const core::CellTraversal walk(ray, header.frame, header.region);
  core::Cursor cursor = core::arrive(start);
  return core::RayTraversal(ray, cursor, records, operations).first_leaf(walk, header);
}

core::Ray random_ray(apps::Random& random, const core::GridFrame& frame) {
  core::Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = static_cast<double>(core::grid_size(frame)[axis]) * double{frame.finest_cell};
    ray.origin[axis] = static_cast<float>(core::plane_at(frame, axis, 0) + extent * (1.6 * random.unit() - 0.3));
    ray.direction[axis] = static_cast<float>(2 * random.unit() - 1);
  }
  return ray;
}

}  // namespace

TEST_CASE("a proxy takes no more room than it is given, and all BVH nodes if they fit") {
  const Hat hat;
  std::size_t before = 0;
  for (const std::size_t bytes_max : {3000U, 6000U, 12000U}) {
    const core::DatabasePart proxy = core::proxy_of(hat.database, bytes_max);
    CHECK(proxy.header.directory != core::no_address);
    CHECK(proxy.record_bytes <= bytes_max);
    CHECK(proxy.record_bytes >= before);
    CHECK(proxy.bytes.size() == proxy.record_bytes + core::overread_bytes);
    before = proxy.record_bytes;
  }
  CHECK(before > 6000);
  CHECK(core::proxy_of(hat.database, 1U << 20U).record_bytes == core::proxy_of(hat.database, 1U << 30U).record_bytes);
}

TEST_CASE("a proxy that has no room for the topmost BVH nodes has none, nor a directory") {
  const Hat hat;
  for (const std::size_t bytes_max : {0U, 8U, 400U}) {
    const core::DatabasePart proxy = core::proxy_of(hat.database, bytes_max);
    CHECK(proxy.header.directory == core::no_address);
    CHECK(proxy.header.frame.finest_cell == hat.database.header().frame.finest_cell);
  }
}

TEST_CASE("no ray hits anything before the first leaf of any proxy, and what it hits has one") {
  const Hat hat;
  const core::DatabaseHeader& whole = hat.database.header();
  apps::Random random(20'263);
  std::uint32_t hits = 0, misses_known = 0, misses_known_coarsely = 0;
  const core::DatabasePart coarse = core::proxy_of(hat.database, 3000), fine = core::proxy_of(hat.database, 1U << 20U);
  for (int i = 0; i < 4000; ++i) {
    const core::Ray ray = random_ray(random, whole.frame);
    const auto start = core::first_passage(ray, whole.frame);
    if (!start) {
      continue;
    }
    core::Operations operations;
    const float of_coarse = first_leaf(coarse.header, coarse.bytes, ray, *start, operations);
    const float of_fine = first_leaf(fine.header, fine.bytes, ray, *start, operations);
    CHECK((of_coarse != never || of_fine == never));
    CHECK(of_fine == first_leaf(whole, hat.database.bytes(), ray, *start, operations));
    core::LocalRecords records(hat.database.bytes());
    core::Cursor cursor = core::arrive(*start);
    if (core::trace(ray, cursor, records, whole, {}, operations) == core::Traced::hit) {
      CHECK(of_coarse <= cursor.best.t);
      CHECK(of_fine <= cursor.best.t);
      ++hits;
    } else {
      misses_known += of_fine == never ? 1 : 0;
      misses_known_coarsely += of_coarse == never ? 1 : 0;
    }
  }
  CHECK(hits > 50);
  CHECK(misses_known > misses_known_coarsely);
  CHECK(misses_known_coarsely > 100);
}

TEST_CASE("a proxy of voxels has their directory, or that of cubes of voxels, and no list outside it") {
  const core::Database database = core::build_database(
      tests::built_in("sombrero-1"), {.structure = core::Structure::voxels, .voxels = {.voxels_per_primitive = 30}});
  const auto& count = database.header().directory_size;
  const core::LocalRecords whole(database.bytes());
  for (const std::size_t bytes_max : {512U, 4096U, 1U << 24U}) {
    const core::DatabasePart proxy = core::proxy_of(database, bytes_max);
    REQUIRE(proxy.header.directory != core::no_address);
    CHECK(proxy.record_bytes <= bytes_max);
    CHECK((proxy.header.directory_doublings > 0) == (bytes_max < 1U << 24U));
    const core::LocalRecords records(proxy.bytes);
    const auto is_empty = [](const core::DatabaseHeader& header, const core::LocalRecords& in, const core::Corner& cell) {
      const std::uint64_t index = core::directory_index(header, cell);
      return core::read<core::DirectoryEntry>(in.find(core::directory_address(header, index)) + core::directory_offset(index))
          .empty();
    };
    std::uint64_t missing = 0, occupied = 0;
    core::Corner at;
    for (at[0] = 0; at[0] < count[0] * core::finest_per_macro; at[0] += core::finest_per_macro) {
      for (at[1] = 0; at[1] < count[1] * core::finest_per_macro; at[1] += core::finest_per_macro) {
        for (at[2] = 0; at[2] < count[2] * core::finest_per_macro; at[2] += core::finest_per_macro) {
          const bool is_listed = !is_empty(database.header(), whole, at);
          occupied += is_listed ? 1 : 0;
          missing += is_listed && is_empty(proxy.header, records, core::doubled(at, proxy.header.directory_doublings)) ? 1 : 0;
        }
      }
    }
    CHECK(occupied > 0);
    CHECK(missing == 0);
  }
  CHECK(core::proxy_of(database, 100).header.directory == core::no_address);
}

}  // namespace proxy_test
