#include "apps/foreign/gltf/places.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"

namespace dmpc::tests::skin_test {

namespace {

using apps::MeshFile;
using core::Vec3d;

/// The triangle (0 0 0) (2 0 0) (0 1 0), its corners held by joints of one skin or two.
struct Rig {
  std::array<std::uint8_t, 12> joints{};
  std::array<float, 12> weights{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  std::string nodes =
      R"({"mesh":0,"skin":0,"translation":[50,0,0],"scale":[0,0,0]},{"translation":[0,0,3]},{"scale":[100,100,100]})";
  std::string roots = "0,1,2", skins = R"([{"joints":[1,2]}])";
  std::string binds;  ///< the matrices' diagonals: as many numbers as joints

  std::string text() const {
    GltfDocument document;
    const std::array<float, 9> normals{0, 0, 1, 0, 1, 0, 1, 0, 0};
    const std::string attributes = R"({"attributes":{"POSITION":)" + document.add(triangle_corners, 3) + R"(,"NORMAL":)" +
                                   document.add(normals, 3) + R"(,"JOINTS_0":)" + document.add(joints, 4) + R"(,"WEIGHTS_0":)" +
                                   document.add(weights, 4) + "}}";
    document.node = nodes;
    std::vector<float> matrices;
    for (const char scale : binds) {
      const auto s = static_cast<float>(scale - '0');
      matrices.insert(matrices.end(), {s, 0, 0, 0, 0, s, 0, 0, 0, 0, s, 0, 0, 0, 0, 1});
    }
    std::string bound = skins;
    if (!binds.empty()) {
      bound.insert(bound.find('{') + 1, R"("inverseBindMatrices":)" + document.add(matrices, 16) + ",");
    }
    std::string text = document.text(attributes, R"("skins":)" + bound);
    return text.replace(text.find(R"("nodes":[0])"), 11, R"("nodes":[)" + roots + "]");
  }
};

MeshFile read(const std::string& text) { return read_mesh("a.gltf", text); }

std::string complaint(const Rig& rig) { return mesh_refusal("a.gltf", rig.text()); }

}  // namespace

TEST_CASE("a skinned mesh stands where its joints hold it, whatever its node's own transform") {
  Rig rig;
  rig.joints = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
  rig.weights = {1, 0, 0, 0, 1, 0, 0, 0, 0.25F, 0.25F, 0, 0};  // the last as shares of their sum
  rig.binds = "12";
  const MeshFile file = read(rig.text());
  REQUIRE(file.scene.vertices.size() == 3);
  CHECK(file.scene.vertices[0] == Vec3d{0, 0, 3});
  CHECK(file.scene.vertices[1] == Vec3d{400, 0, 0});      // 100 times 2 times 2
  CHECK(file.scene.vertices[2] == Vec3d{0, 100.5, 1.5});  // half of (0 1 3), half of (0 200 0)
  REQUIRE(file.scene.normals.size() == 3);
  CHECK(file.scene.normals[1] == Vec3d{0, 1, 0});
}

TEST_CASE("a skin without matrices binds its joints where they are, and a hidden joint holds all the same") {
  Rig rig;
  rig.nodes = R"({"mesh":0,"skin":0},{"translation":[0,0,3],"extensions":{"KHR_node_visibility":{"visible":false}}},{})";
  CHECK(read(rig.text()).scene.vertices[1] == Vec3d{2, 0, 3});
}

TEST_CASE("one mesh may stand with several skins, and without any") {
  Rig rig;
  rig.nodes =
      R"({"mesh":0,"skin":0},{"translation":[0,0,3]},{"translation":[0,0,4]},{"mesh":0,"skin":1},{"mesh":0,"translation":[0,0,5]})";
  rig.roots = "0,1,2,3,4";
  rig.skins = R"([{"joints":[1]},{"joints":[2]}])";
  const MeshFile file = read(rig.text());
  REQUIRE(file.scene.vertices.size() == 9);
  CHECK(file.scene.vertices[0] == Vec3d{0, 0, 3});
  CHECK(file.scene.vertices[3] == Vec3d{0, 0, 4});
  CHECK(file.scene.vertices[6] == Vec3d{0, 0, 5});
}

TEST_CASE("a skin that does not hold together is refused, with its place") {
  Rig rig;
  rig.joints[0] = 7;
  CHECK(contains(complaint(rig), "skins[0]: vertex 0 is held by joint 7, which does not exist: there are 2"));
  rig.weights[0] = 0;
  CHECK(complaint(rig).empty());  // a joint that holds nothing may be any
  rig.weights[0] = -1;
  rig.joints[0] = 0;
  CHECK(contains(complaint(rig), "skins[0]: vertex 0 is held with a weight that is below 0"));
  rig = Rig{.binds = "1"};
  CHECK(contains(complaint(rig), "has 1 matrices, expected one for each of 2 joints"));
  CHECK(contains(complaint(Rig{.skins = R"([{"joints":[9]}])"}), "refers to nodes[9]"));
  CHECK(contains(complaint(Rig{.roots = "0,1"}), "is of nodes[2], which does not stand in the scene"));
  CHECK(contains(complaint(Rig{.skins = "[]"}), "refers to skins[0]"));
}

}  // namespace dmpc::tests::skin_test
