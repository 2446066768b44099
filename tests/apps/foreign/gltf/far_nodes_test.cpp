// Scenes whose nodes stand far from the origin, as surveyed and astronomical ones do.

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/frontend/line/number_text.h"
#include "tests/support/mesh_files.h"
#include "tests/support/pbrt_scenes.h"
#include "tests/support/read_mesh.h"

namespace dmpc::apps::far_nodes_test {

namespace {

using core::Vec3d;

const std::array<double, 4> heights = {0, 0.7, -1.3, 2.1};

std::string text_of(const Vec3d& v, const std::string& between) {
  return shortest(v.x) + between + shortest(v.y) + between + shortest(v.z);
}

/// Where the triangle stands: some units from each other, all far away.
std::vector<Vec3d> places(double far) {
  std::vector<Vec3d> all;
  for (const double height : heights) {
    all.push_back({far + height, -far, 0.3 * far + 2 * height});
  }
  return all;
}

Vec3d corner(std::size_t i) {
  const auto& all = tests::triangle_corners;
  return {double{all[3 * i]}, double{all[3 * i + 1]}, double{all[3 * i + 2]}};
}

/// Nodes that move the triangle, by a translation or a matrix, and one with a camera.
std::string gltf(double far, bool has_matrices) {
  std::string nodes, roots;
  for (const Vec3d& place : places(far)) {
    roots += std::to_string(nodes.empty() ? 0 : std::count(nodes.begin(), nodes.end(), '{')) + ",";
    nodes += has_matrices ? R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,)" + text_of(place, ",") + ",1]},"
                          : R"({"mesh":0,"translation":[)" + text_of(place, ",") + "]},";
  }
  tests::Gltf document{.nodes = "[" + nodes + R"({"camera":0,"translation":[)" + text_of(places(far)[1], ",") + "]}]",
                       .roots = "[" + roots + std::to_string(heights.size()) + "]"};
  document.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1}}])";
  return document.text();
}

std::string obj(double far) {
  std::string text;
  for (const Vec3d& place : places(far)) {
    for (std::size_t i = 0; i < 3; ++i) {
      text += "v " + text_of(corner(i) + place, " ") + "\n";
    }
    text += "f -3 -2 -1\n";
  }
  return text;
}

std::string pbrt(double far) {
  std::string text;
  for (const Vec3d& place : places(far)) {
    text += "Identity Translate " + text_of(place, " ") + " Shape \"trianglemesh\" \"point3 P\" [";
    for (std::size_t i = 0; i < 3; ++i) {
      text += text_of(corner(i), " ") + " ";
    }
    text += "]\n";
  }
  return text;
}

}  // namespace

TEST_CASE("nodes far from the origin place what OBJ and pbrt place there, to the last bit") {
  for (const double far : {1e3, 1e6, 1e8}) {
    CAPTURE(far);
    const std::vector<Vec3d> expected = tests::read_mesh("a.obj", obj(far)).scene.vertices;
    REQUIRE(expected.size() == 3 * heights.size());
    CHECK(tests::read_mesh("a.gltf", gltf(far, false)).scene.vertices == expected);
    CHECK(tests::read_mesh("a.gltf", gltf(far, true)).scene.vertices == expected);
    CHECK(tests::read_pbrt(pbrt(far)).scene.vertices == expected);
  }
}

TEST_CASE("a camera far from the origin stands where its node does, to the last bit") {
  const core::View view = tests::read_mesh("a.gltf", gltf(4e5, false)).scene.view;
  CHECK(view.from == places(4e5)[1]);
  CHECK(view.at - view.from == Vec3d{0, 0, -1});
}

}  // namespace dmpc::apps::far_nodes_test
