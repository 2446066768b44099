// Bundles of which somebody else traces a part: nothing differs from a bundle that has all records.
#include "core/trace/bundle_below.h"

#include <doctest/doctest.h>

#include <bit>
#include <memory>
#include <vector>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "tests/support/small_scenes.h"

namespace bundle_below_test {

namespace {

using namespace dmpc;
using core::RayBundle;
using core::RayMask;

struct ForestRecords {
  core::LocalRecords all;
  std::uint64_t forest_bytes;

  const std::byte* find(core::Address address) { return core::byte_offset(address) < forest_bytes ? all.find(address) : nullptr; }
};

/// Has somebody else answer what the rays of a bundle wait for. Returns the number of questions.
std::uint32_t ask(RayBundle& bundle, RayBundle& answering, core::LocalRecords all, const core::DatabaseHeader& header,
                  core::Operations& operations) {
  std::vector<core::Below> asked;
  std::vector<std::size_t> asking;
  for (RayMask rays = bundle.next_rays; rays != 0; rays &= rays - 1) {
    asking.push_back(static_cast<std::size_t>(std::countr_zero(rays)));
    asked.push_back(core::below(bundle, asking.back()));
  }
  core::trace_below(answering, asked, all, header, operations);
  for (std::size_t i = 0; i < asking.size(); ++i) {
    CHECK(core::take_below(bundle, asking[i], core::found_below(answering, i), operations) == (i + 1 == asking.size()));
  }
  return static_cast<std::uint32_t>(asking.size());
}

}  // namespace

TEST_CASE("bundles whose walks below the forest others do meet what they would alone, by the same operations") {
  for (const char* name : {"gears-1", "teapot-4", "balls-3"}) {
    const core::Scene scene = tests::built_in(name);
    const core::Database database = core::build_database(scene, {.page_size_bytes = 512, .structure = core::Structure::extents});
    core::LocalRecords all(database.bytes());
    ForestRecords forest{all, database.forest_page_count() * database.page_size()};
    const core::Camera camera(scene.view, database.header().frame, 32, 32, 1);
    const auto one = std::make_unique<RayBundle>(), other = std::make_unique<RayBundle>(),
               answering = std::make_unique<RayBundle>();
    core::Operations alone, shared;
    std::uint32_t questions = 0;
    for (std::uint32_t first = 0; first + core::bundle_rays_max <= 32 * 32; first += one->count) {
      one->count = other->count = 1 + first % core::bundle_rays_max;
      for (std::uint32_t i = 0; i < one->count; ++i) {
        one->rays[i] = camera.primary_ray(first + i, 0);
        one->rays[i].kind = first % 3 == 0 ? core::RayKind::shadow : core::RayKind::primary;
        other->rays[i] = one->rays[i];
      }
      one->start();
      other->start();
      CHECK(core::trace(*one, all, database.header(), {}, alone));
      while (!core::trace(*other, forest, database.header(), {}, shared)) {
        questions += ask(*other, *answering, all, database.header(), shared);
      }
      CHECK(other->found == one->found);
      for (std::uint32_t i = 0; i < one->count; ++i) {
        CHECK(other->hit(i).t == one->hit(i).t);
        CHECK(other->hit(i).primitive == one->hit(i).primitive);
        CHECK(other->hit(i).leaf == one->hit(i).leaf);
        CHECK(other->hit(i).lane == one->hit(i).lane);
      }
    }
    CHECK(questions > 100);
    CHECK(shared.bvh_node_reads == alone.bvh_node_reads);
    CHECK(shared.primitive_tests == alone.primitive_tests);
    CHECK(shared.cell_steps == alone.cell_steps);
    CHECK(shared.skipped.any_hit == alone.skipped.any_hit);
    CHECK(shared.skipped.bundles == alone.skipped.bundles);
  }
}

TEST_CASE("a ray of a bundle takes one answer, which is nearer than what was known") {
  const auto bundle = std::make_unique<RayBundle>();
  core::Operations operations;
  bundle->any = false;
  bundle->found = 0;
  bundle->waiting.count = 0;
  bundle->next_rays = 0b101;
  bundle->best.set(0, {5, 10, core::Address{7}, 1});
  CHECK_THROWS_AS(core::take_below(*bundle, 1, {}, operations), core::InternalError);
  CHECK_THROWS_AS(core::take_below(*bundle, 0, {5, 10, core::Address{9}, 2}, operations), core::InternalError);
  CHECK_FALSE(core::take_below(*bundle, 0, {5, 9, core::Address{9}, 2}, operations));
  CHECK(bundle->hit(0).primitive == 9);
  CHECK_THROWS_AS(core::take_below(*bundle, 0, {}, operations), core::InternalError);
  CHECK(core::take_below(*bundle, 2, {}, operations));
  CHECK(bundle->found == 0b001);
}

TEST_CASE("rays that go on below different children make no bundle") {
  const auto bundle = std::make_unique<RayBundle>();
  std::vector<core::Below> rays(2, core::Below{.child = core::BvhChild::bvh_node(core::Address{100})});
  rays[1].child = core::BvhChild::bvh_node(core::Address{200});
  core::DatabaseHeader header;
  CHECK_THROWS_AS(core::set_rays(*bundle, rays, header), core::InternalError);
  CHECK_THROWS_AS(core::set_rays(*bundle, {}, header), core::InternalError);
}

}  // namespace bundle_below_test
