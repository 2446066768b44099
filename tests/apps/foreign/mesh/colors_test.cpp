// Colours of vertices and alpha of textures, from glTF files to scenes.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <type_traits>

#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"

namespace dmpc::apps::colors_test {

namespace {

/// The triangle with a colour at each corner.
template <class T, std::size_t width>
std::string colored_gltf(const std::array<T, 3 * width>& colors, const std::string& material) {
  tests::GltfDocument document;
  const std::string positions = document.add(tests::triangle_corners, 3);
  const std::string shown = document.add(colors, width, std::is_floating_point_v<T> ? "" : R"("normalized":true)");
  return document.text(R"({"attributes":{"POSITION":)" + positions + R"(,"COLOR_0":)" + shown + R"(},"material":0})",
                       R"("materials":[)" + material + "]");
}

MeshFile read(const std::string& text) { return tests::read_mesh("a.gltf", text); }

core::CornerColor color_of(const core::TexturedCorner& corner) { return std::bit_cast<core::CornerColor>(corner.place); }

const std::string matte = R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,0.5],"metallicFactor":0})";

}  // namespace

TEST_CASE("vertices' colours come as bytes, as words and as floats, with and without alpha, which counts where it is asked for") {
  const core::CornerColor half{65535, 0, 128 * 257, 65535};
  for (const core::Scene& scene :
       {read(colored_gltf<std::uint8_t, 4>({255, 0, 128, 9, 0, 255, 0, 9, 0, 0, 255, 9}, matte + "}")).scene,
        read(colored_gltf<std::uint16_t, 3>({65535, 0, 128 * 257, 0, 65535, 0, 0, 0, 65535}, matte + "}")).scene,
        read(colored_gltf<float, 3>({1, 0, 128 / 255.0F, 0, 1, 0, 0, 0, 1}, matte + "}")).scene}) {
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.objects[0].kind == core::ObjectKind::textured);
    CHECK(scene.materials.at(0).texture == core::Material::no_texture);
    CHECK(!scene.materials[0].lets_through());
    REQUIRE(scene.corners.size() == 3);
    CHECK(color_of(scene.corners[0]) == half);
    CHECK(color_of(scene.corners[1]) == core::CornerColor{0, 65535, 0, 65535});
  }
  const MeshFile blended =
      read(colored_gltf<std::uint8_t, 4>({255, 0, 128, 0, 0, 255, 0, 255, 0, 0, 255, 51}, matte + R"(,"alphaMode":"BLEND"})"));
  CHECK(blended.scene.materials.at(0).alpha == core::AlphaUse::blend);
  CHECK(color_of(blended.scene.corners.at(0))[3] == 0);
  CHECK(color_of(blended.scene.corners.at(2))[3] == 51 * 257);
  CHECK(tests::notes(blended, "cast whole shadows"));
}

TEST_CASE("a face of one colour is a plain face of that colour, and white vertices change nothing") {
  const core::Scene red = read(colored_gltf<float, 3>({1, 0.5F, 0, 1, 0.5F, 0, 1, 0.5F, 0}, matte + "}")).scene;
  CHECK(red.objects.at(0).kind == core::ObjectKind::polygon);
  CHECK(red.materials.at(red.objects[0].material).color == core::Vec3d{1, 0.25, 0});
  const core::Scene white = read(colored_gltf<float, 3>({1, 1, 1, 1, 1, 1, 1, 1, 1}, matte + "}")).scene;
  CHECK(white.objects.at(0).kind == core::ObjectKind::polygon);
  CHECK(white.materials.size() == 1);
}

}  // namespace dmpc::apps::colors_test
