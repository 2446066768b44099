#include "core/scene/placed_objects.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "core/base/expect.h"
#include "core/scene/instances.h"
#include "tests/support/instanced_scene.h"
#include "tests/support/placed_meshes.h"
#include "tests/support/same_scene.h"

namespace dmpc::tests::placed_objects_test {
namespace {

using core::Object;
using core::ObjectKind;
using core::PlacedObject;
using core::PlacedObjects;
using core::Scene;
using core::Vec3d;

constexpr std::uint64_t seeds = 40;

Scene expanded(std::uint64_t seed) {
  auto [scene, instances] = instanced_scene(seed);
  expand(scene, instances);
  return scene;
}

Scene left(std::uint64_t seed) {
  auto [scene, instances] = instanced_scene(seed);
  leave(scene, instances);
  return scene;
}

/// Kind, material, number of corners, and the bits of all that an object has where it stands.
using Reported = std::vector<std::uint64_t>;

void add(Reported& reported, const Vec3d& v) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reported.push_back(std::bit_cast<std::uint64_t>(v[axis]));
  }
}

Reported reported(const PlacedObject& placed) {
  const Object& object = placed.object();
  Reported result{static_cast<std::uint64_t>(object.kind), object.material, object.vertex_count};
  if (object.kind == ObjectKind::sphere) {
    add(result, placed.pools().spheres[object.first].center);
  } else if (object.kind == ObjectKind::cone) {
    add(result, placed.pools().cones[object.first].apex);
  }
  for (std::uint32_t i = 0; i < object.vertex_count; ++i) {
    add(result, placed.vertex(i));
    if (object.kind == ObjectKind::patch) {
      add(result, placed.normal(i));
    } else if (object.kind == ObjectKind::textured) {
      add(result, placed.corner(i).normal);
      result.push_back(std::bit_cast<std::uint32_t>(placed.corner(i).place[0]));
    }
  }
  return result;
}

std::vector<Reported> all_reported(const Scene& scene, std::uint64_t stride = 1) {
  std::vector<Reported> all;
  PlacedObjects(scene).for_each([&](const PlacedObject& object) { all.push_back(reported(object)); }, stride);
  return all;
}

bool same_corners(const Scene& a, const Scene& b) {
  bool same = a.corners.size() == b.corners.size();
  for (std::size_t i = 0; same && i < a.corners.size(); ++i) {
    same = a.corners[i].normal == b.corners[i].normal &&
           std::bit_cast<std::uint64_t>(a.corners[i].place) == std::bit_cast<std::uint64_t>(b.corners[i].place);
  }
  return same;
}

}  // namespace

TEST_CASE("a scene that leaves copies out has of a base mesh its places, and none of its objects") {
  Scene scene = in_floats(rug_on_floor(false, true, 6));
  leave(scene, {.meshes = {{0, 72}}, .places = std::vector<core::Instance>(1000, {turned_place(1, {}, true), 0, 73})});
  CHECK(scene.objects.size() == 1);  // the floor
  CHECK(scene.vertices.size() == 4);
  CHECK(scene.kept->meshes.size() == 1);
  CHECK(scene.kept->places.size() == 1000);
  CHECK(scene.kept->places[999].first == 1 + 999 * 72);
  CHECK(leaves_copies_out(scene));
  CHECK(object_count(scene) == 72001);
}

TEST_CASE("it has all objects of the expanded one, in its order and to the bit: by places, sizes, mirrors, kinds") {
  std::uint64_t copies = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    const Scene whole = expanded(seed), without = left(seed);
    REQUIRE(object_count(without) == whole.objects.size());
    REQUIRE(all_reported(without) == all_reported(whole));
    copies += whole.objects.size() - without.objects.size();
  }
  CHECK(copies > 1000 * seeds);
}

TEST_CASE("every third object is the same, too, wherever meshes begin") {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    const Scene without = left(seed);
    const std::vector<Reported> all = all_reported(without), thirds = all_reported(without, 3);
    REQUIRE(thirds.size() == (all.size() + 2) / 3);
    for (std::size_t i = 0; i < thirds.size(); ++i) {
      REQUIRE(thirds[i] == all[3 * i]);
    }
  }
}

TEST_CASE("copies that are put make it the expanded one, and taken out leave it") {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    const Scene whole = expanded(seed), without = left(seed);
    Scene put = without;
    put_copies(put);
    CHECK_FALSE(leaves_copies_out(put));
    CHECK(same_scene(put, whole));
    CHECK(same_corners(put, whole));
    Scene own = without_copies(whole);
    own.materials = whole.materials;
    own.view = without.view;
    CHECK(same_scene(own, without));
    CHECK(same_corners(own, without));
    CHECK(without_copies(without).objects.size() == without.objects.size());
  }
}

TEST_CASE("copies may be put in some places alone: the objects stay, and those that are copies know their places") {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    const Scene whole = expanded(seed), without = left(seed);
    if (without.kept == nullptr) {
      continue;
    }
    std::vector<bool> odd;
    for (std::size_t i = 0; i < without.kept->places.size(); ++i) {
      odd.push_back(i % 2 == 1);
    }
    Scene some = without;
    put_copies(some, odd);
    CHECK(leaves_copies_out(some));
    CHECK(some.objects.size() == size_with_copies(without, odd).objects);
    CHECK(object_count(some) == whole.objects.size());
    CHECK(all_reported(some) == all_reported(whole));
    CHECK(same_corners(without_copies(some), without_copies(whole)));
    CHECK(without_copies(some).objects.size() == without.objects.size());
    std::vector<std::uint64_t> copies(odd.size());
    for (std::uint32_t i = 0; i < some.objects.size(); ++i) {
      if (const core::BaseMeshInstance* const place = place_of(some, i)) {
        ++copies[place - some.kept->places.data()];
      }
    }
    for (std::size_t i = 0; i < odd.size(); ++i) {
      const std::size_t size = some.kept->meshes[some.kept->places[i].mesh].objects.size();
      REQUIRE(copies[i] == (odd[i] ? size : 0));
    }
    put_copies(some);
    CHECK_FALSE(leaves_copies_out(some));
    CHECK(same_scene(some, whole));
    CHECK(same_corners(some, whole));
  }
}

TEST_CASE("a scene that leaves copies out is sent with them, as the expanded one is") {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    CAPTURE(seed);
    Scene from_whole, from_left;
    core::SceneBuilder to_whole(from_whole), to_left(from_left);
    replay(expanded(seed), to_whole);
    replay(left(seed), to_left);
    CHECK(same_scene(from_left, from_whole));
  }
}

TEST_CASE("a scene without base meshes leaves nothing out") {
  auto [scene, instances] = instanced_scene(7);
  instances.places.resize(1);
  leave(scene, instances);
  CHECK(scene.kept == nullptr);
  CHECK_FALSE(leaves_copies_out(scene));
  CHECK(object_count(scene) == scene.objects.size());
  const std::vector<Reported> before = all_reported(scene);
  put_copies(scene);
  CHECK(all_reported(scene) == before);
}

TEST_CASE("a thousand million objects are left out in a moment, and more than indices reach are an error") {
  const auto left_with = [](std::uint32_t places) {
    Scene scene = in_floats(rug_on_floor(false, true, 100));
    const core::Instance place{turned_place(1, {}, false), 0, 20'001};
    leave(scene, {.meshes = {{0, 20'000}}, .places = std::vector<core::Instance>(places, place)});
    return object_count(scene);
  };
  CHECK(left_with(50'000) == 1'000'000'001);
  CHECK(left_with(214'748) == 4'294'960'001);
  CHECK_THROWS_AS(left_with(214'749), core::CapacityError);
}

}  // namespace dmpc::tests::placed_objects_test
