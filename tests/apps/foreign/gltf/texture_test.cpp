// Textures of glTF: their transforms, and pictures within a document.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::gltf_texture_test {

namespace {

using Place = std::array<float, 2>;

/// The places on its texture of a triangle whose corners have (0 0), (1 0) and (0 0.5), and as its second set (0.25 0.25) thrice.
std::array<Place, 3> places_by(const std::string& info, const std::string& image = R"({"uri":"a.png"})",
                               std::vector<std::string>* notes = nullptr, const std::string& material = "") {
  const TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(2, 2));
  GltfDocument document;
  const std::string positions = document.add(triangle_corners, 3);
  const std::string first = document.add(std::array<float, 6>{0, 0, 1, 0, 0, 0.5F}, 2);
  const std::size_t second = document.accessor(
      document.view(bytes_of(std::array<std::uint8_t, 12>{51, 51, 0, 0, 51, 51, 0, 0, 51, 51}), R"("byteStride":4)"), 5121, 3,
      "VEC2", R"("normalized":true)");
  std::string picture = image;
  if (image == "within") {
    picture = R"({"mimeType":"png","bufferView":)" + std::to_string(document.view(file_text(folder / "a.png"))) + "}";
  }
  write_text(folder / "a.gltf",
             document.text(R"({"material":0,"attributes":{"POSITION":)" + positions + R"(,"TEXCOORD_0":)" + first +
                               R"(,"TEXCOORD_1":)" + std::to_string(second) + "}}",
                           R"("materials":[{)" + material + R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0)" + info +
                               R"(}}}],"textures":[{"source":0}],"images":[)" + picture + "]"));
  const apps::MeshFile file = apps::read_mesh_file(folder / "a.gltf");
  REQUIRE(file.scene.corners.size() == 3);
  if (notes != nullptr) {
    *notes = file.notes;
  }
  return {file.scene.corners[0].place, file.scene.corners[1].place, file.scene.corners[2].place};
}

std::string transformed(const std::string& members) { return R"(,"extensions":{"KHR_texture_transform":{)" + members + "}}"; }

void check_places(const std::array<Place, 3>& places, const std::array<Place, 3>& expected) {
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(places[i][0] == doctest::Approx(expected[i][0]).epsilon(1e-6));
    CHECK(places[i][1] == doctest::Approx(expected[i][1]).epsilon(1e-6));
  }
}

}  // namespace

TEST_CASE("texture coordinates are scaled, then turned, then moved") {
  check_places(places_by(""), {{{0, 0}, {1, 0}, {0, 0.5F}}});
  check_places(places_by(transformed(R"("offset":[0.5,0.25])")), {{{0.5F, 0.25F}, {1.5F, 0.25F}, {0.5F, 0.75F}}});
  check_places(places_by(transformed(R"("scale":[2,3])")), {{{0, 0}, {2, 0}, {0, 1.5F}}});
  check_places(places_by(transformed(R"("rotation":1.5707963267948966)")), {{{0, 0}, {0, -1}, {0.5F, 0}}});
  check_places(places_by(transformed(R"("offset":[1,0],"scale":[2,3],"rotation":1.5707963267948966)")),
               {{{1, 0}, {1, -2}, {2.5F, 0}}});
}

TEST_CASE("a transform may take another set of coordinates") {
  check_places(places_by(R"(,"texCoord":1)"), {{{0.2F, 0.2F}, {0.2F, 0.2F}, {0.2F, 0.2F}}});
  check_places(places_by(transformed(R"("texCoord":1,"scale":[5,10])")), {{{1, 2}, {1, 2}, {1, 2}}});
}

TEST_CASE("a picture within a document is what its bytes are, whatever its type is called") {
  check_places(places_by("", "within"), {{{0, 0}, {1, 0}, {0, 0.5F}}});
}

TEST_CASE("a texture without alpha that is to blend is shown as it is, without a word") {
  std::vector<std::string> notes;
  places_by("", R"({"uri":"a.png"})", &notes, R"("alphaMode":"BLEND",)");
  const std::string all = std::accumulate(notes.begin(), notes.end(), std::string());
  CHECK(count(all, "shown without") == 0);
  CHECK(count(all, "cast whole shadows") == 0);
}

TEST_CASE("a texture of glTF that names no picture is said") {
  const TemporaryFolder folder;
  Gltf gltf{.materials = R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])"};
  gltf.more = R"("textures":[{}])";
  write_text(folder / "a.gltf", gltf.text());
  const auto notes = apps::read_mesh_file(folder / "a.gltf").notes;
  CHECK(std::count(notes.begin(), notes.end(), "textures that name no picture, left out: 1") == 1);
}

}  // namespace dmpc::tests::gltf_texture_test
