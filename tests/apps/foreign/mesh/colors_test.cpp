// Colours of vertices and alpha of textures, from glTF files to scenes.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>

#include "apps/formats/mesh_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::colors_test {

namespace {

/// The triangle with a colour at each corner; `type` is 5121 (bytes), 5123 or 5126.
template <class T, std::size_t width>
std::string colored_gltf(const std::array<T, 3 * width>& colors, int type, const std::string& material) {
  const tests::Gltf plain;
  const std::string bytes = tests::bytes_of(tests::triangle_corners) + tests::bytes_of(colors);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)"
         R"("attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"materials":[)" +
         material +
         R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,1,0]},)"
         R"({"bufferView":1,"count":3,"normalized":)" +
         (type == 5126 ? "false" : "true") + R"(,"componentType":)" + std::to_string(type) + R"(,"type":"VEC)" +
         std::to_string(width) + R"("}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" +
         std::to_string(sizeof colors) + R"(}],"buffers":[{"byteLength":)" + std::to_string(bytes.size()) +
         R"(,"uri":"data:application/octet-stream;base64,)" + tests::base64(bytes) + R"("}]})";
}

MeshFile read(const std::string& text) {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.gltf", text);
  return read_mesh_file(folder / "a.gltf");
}

core::CornerColor color_of(const core::TexturedCorner& corner) { return std::bit_cast<core::CornerColor>(corner.place); }

const std::string matte = R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,1,0.5],"metallicFactor":0})";

bool has(const MeshFile& file, const std::string& part) {
  return std::any_of(file.notes.begin(), file.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("vertices' colours come as bytes, as words and as floats, with and without alpha, which counts where it is asked for") {
  const core::CornerColor half{65535, 0, 128 * 257, 65535};
  for (const core::Scene& scene :
       {read(colored_gltf<std::uint8_t, 4>({255, 0, 128, 9, 0, 255, 0, 9, 0, 0, 255, 9}, 5121, matte + "}")).scene,
        read(colored_gltf<std::uint16_t, 3>({65535, 0, 128 * 257, 0, 65535, 0, 0, 0, 65535}, 5123, matte + "}")).scene,
        read(colored_gltf<float, 3>({1, 0, 128 / 255.0F, 0, 1, 0, 0, 0, 1}, 5126, matte + "}")).scene}) {
    REQUIRE(scene.objects.size() == 1);
    CHECK(scene.objects[0].kind == core::ObjectKind::textured);
    CHECK(scene.materials.at(0).texture == core::Material::no_texture);
    CHECK(!scene.materials[0].lets_through());
    REQUIRE(scene.corners.size() == 3);
    CHECK(color_of(scene.corners[0]) == half);
    CHECK(color_of(scene.corners[1]) == core::CornerColor{0, 65535, 0, 65535});
  }
  const MeshFile blended = read(
      colored_gltf<std::uint8_t, 4>({255, 0, 128, 0, 0, 255, 0, 255, 0, 0, 255, 51}, 5121, matte + R"(,"alphaMode":"BLEND"})"));
  CHECK(blended.scene.materials.at(0).alpha == core::AlphaUse::blend);
  CHECK(color_of(blended.scene.corners.at(0))[3] == 0);
  CHECK(color_of(blended.scene.corners.at(2))[3] == 51 * 257);
  CHECK(has(blended, "cast whole shadows"));
}

TEST_CASE("a face of one colour is a plain face of that colour, and white vertices change nothing") {
  const core::Scene red = read(colored_gltf<float, 3>({1, 0.5F, 0, 1, 0.5F, 0, 1, 0.5F, 0}, 5126, matte + "}")).scene;
  CHECK(red.objects.at(0).kind == core::ObjectKind::polygon);
  CHECK(red.materials.at(red.objects[0].material).color == core::Vec3d{1, 0.25, 0});
  const core::Scene white = read(colored_gltf<float, 3>({1, 1, 1, 1, 1, 1, 1, 1, 1}, 5126, matte + "}")).scene;
  CHECK(white.objects.at(0).kind == core::ObjectKind::polygon);
  CHECK(white.materials.size() == 1);
}

}  // namespace dmpc::apps::colors_test
