#include "apps/formats/landscape/scene.h"

#include <doctest/doctest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/formats/landscape/grove.h"
#include "apps/formats/landscape/tree.h"
#include "apps/info/scene_figures.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/scene/placed_objects.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/complaint.h"
#include "tests/support/text.h"

namespace dmpc::apps::landscape_scene_test {

using core::Copies;
using core::Scene;
using core::Vec3d;

namespace {

std::uint64_t bits_of(const Scene& scene) {
  std::uint64_t hash = 0;
  for (const auto* pool : {&scene.vertices, &scene.normals}) {
    for (const Vec3d& v : *pool) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        hash = core::mix(hash ^ std::bit_cast<std::uint64_t>(v[axis]));
      }
    }
  }
  for (const std::uint32_t texel : scene.textures.front().levels.front().texels) {
    hash = core::mix(hash ^ texel);
  }
  return hash;
}

std::uint64_t film_hash(const char* scene, Strategy strategy) {
  RenderOptions options = small(strategy);
  options.picture.scene = scene;
  const Rendered rendered(options);
  CHECK(account_of(*rendered.report).operations.tile_reads > 0);
  return account_of(*rendered.report).film.hash();
}

}  // namespace

TEST_CASE("a landscape and a grove are scenes by their names") {
  CHECK(is_landscape_name("landscape-3"));
  CHECK(is_landscape_name("grove"));
  CHECK_FALSE(is_landscape_name("mount-3"));
  CHECK_THROWS_AS(is_landscape_name("grove-0"), core::InputError);
  CHECK(landscape_scene("landscape-3", Copies::put).objects.size() == 64 + 2);
}

TEST_CASE("a landscape is triangles with a texture, a lake that mirrors, a camera") {
  const SceneFigures figures = figures_of(landscape_scene("landscape-3", Copies::put));
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::textured)] == 64);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::polygon)] == 2);
  CHECK(figures.materials.mirroring == 1);
  REQUIRE(figures.textures.size() == 1);
  CHECK(figures.textures[0].width == 32);
}

TEST_CASE("a grove is a landscape with a tree in each of its places") {
  std::size_t count = 0;
  for (const TreePlaces& places : grove(4).places) {
    count += places.translations.size();
  }
  REQUIRE(count > 100);
  const SceneFigures figures = figures_of(landscape_scene("grove-4", Copies::put));
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::textured)] == std::size_t{1} << 14U);
  CHECK(figures.objects[static_cast<std::size_t>(core::ObjectKind::patch)] == count * (bark_triangles + leaf_triangles));
}

TEST_CASE("a landscape and a grove have the same picture in every strategy") {
  for (const char* name : {"landscape-3", "grove-2"}) {
    const std::uint64_t film = film_hash(name, Strategy::svm);
    CHECK(film_hash(name, Strategy::replicated) == film);
    CHECK(film_hash(name, Strategy::dataflow) == film);
  }
}

TEST_CASE("a grove has the same bits on every machine") {
  CHECK(bits_of(landscape_scene("grove-2", Copies::put)) == 18007247332586769547U);
}

TEST_CASE("copies that are left out are left out of a grove, and the rest is there") {
  const Scene whole = landscape_scene("grove-3", Copies::put), left = landscape_scene("grove-3", Copies::left_out);
  CHECK(object_count(left) == whole.objects.size());
  CHECK(left.objects.size() == 4096 + 2);
  CHECK(left.kept->meshes.size() == tree_kinds);
  CHECK(left.kept->places.size() * 2048 == whole.objects.size() - left.objects.size());
}

TEST_CASE("ten million instanced triangles are no memory to speak of, and a grove that no database holds is refused in figures") {
  const Scene left = landscape_scene("grove-7", Copies::left_out);
  CHECK(object_count(left) > 10'000'000);
  CHECK(left.vertices.size() < 4'000'000);
  const std::string text = tests::complaint_of<core::CapacityError>([] { landscape_scene("grove-10", Copies::put); });
  CHECK(tests::contains(text, "grove-10: its 740,014,080 triangles need a database of at least"));
}

}  // namespace dmpc::apps::landscape_scene_test
