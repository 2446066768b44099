#include "apps/formats/landscape/scene.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "apps/formats/landscape/files.h"
#include "apps/formats/landscape/tree.h"
#include "apps/info/scene_figures.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/scene/placed_objects.h"
#include "tests/support/complaint.h"
#include "tests/support/temporary_folder.h"
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

bool is_near(const Vec3d& a, const Vec3d& b) { return largest_component(a - b) < 1e-6; }

}  // namespace

TEST_CASE("a landscape and a grove are scenes by their names") {
  CHECK(is_landscape_name("landscape-3"));
  CHECK(is_landscape_name("grove"));
  CHECK_FALSE(is_landscape_name("mount-3"));
  CHECK_THROWS_AS(is_landscape_name("grove-0"), core::InputError);
  CHECK(landscape_scene("landscape-3", Copies::put).objects.size() == 64 + 2);
}

TEST_CASE("by name they have what their files have, and are seen from where these are") {
  const tests::TemporaryFolder folder;
  write_grove(2, folder / "grove.gltf");
  const Scene own = landscape_scene("grove-2", Copies::put);
  const Scene read = load_scene(PictureOptions{.scene = folder / "grove.gltf"}, LoadNotes::silent);
  const SceneFigures a = figures_of(own), b = figures_of(read);
  CHECK(a.objects == b.objects);
  CHECK(is_near(a.bounds.low, b.bounds.low));
  CHECK(is_near(a.bounds.high, b.bounds.high));
  CHECK(a.materials.count == b.materials.count);
  CHECK(is_near(own.view.from, read.view.from));
  CHECK(is_near(normalize(own.view.at - own.view.from), normalize(read.view.at - read.view.from)));
  CHECK(std::fabs(own.view.angle_degrees - read.view.angle_degrees) < 0.1);
  CHECK(own.textures.front().levels.front().texels == read.textures.front().levels.front().texels);
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
