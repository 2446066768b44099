#include "apps/formats/landscape/gltf.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace dmpc::apps::gltf_test {

TEST_CASE("the text names its files, and its views make up all numbers") {
  const LandscapeGltf gltf = landscape_gltf(ground_mesh(2), lake_mesh(), "a.bin", "a.png");
  const auto json = nlohmann::json::parse(gltf.json);
  CHECK(json["images"][0]["uri"] == "a.png");
  CHECK(json["buffers"][0]["uri"] == "a.bin");
  CHECK(json["buffers"][0]["byteLength"] == gltf.numbers.size());
  std::size_t end = 0;
  for (const auto& view : json["bufferViews"]) {
    CHECK(view["byteOffset"] == end);
    end += view["byteLength"].get<std::size_t>();
  }
  CHECK(end == gltf.numbers.size());
  CHECK(json["bufferViews"].size() == 8);
  CHECK(json["meshes"].size() == 2);
}

TEST_CASE("the camera's matrix turns and moves, and does not scale") {
  const LandscapeGltf gltf = landscape_gltf(ground_mesh(1), lake_mesh(), "a.bin", "a.png");
  const std::vector<double> matrix = nlohmann::json::parse(gltf.json)["nodes"][2]["matrix"];
  REQUIRE(matrix.size() == 16);
  for (std::size_t column = 0; column < 3; ++column) {
    CHECK(matrix[4 * column] * matrix[4 * column] + matrix[4 * column + 1] * matrix[4 * column + 1] +
              matrix[4 * column + 2] * matrix[4 * column + 2] ==
          doctest::Approx(1));
    CHECK(matrix[4 * column + 3] == 0);
  }
  CHECK(matrix[15] == 1);
}

}  // namespace dmpc::apps::gltf_test
