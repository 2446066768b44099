// What a mesh file has and a picture of ours does not show.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::features_test {

namespace {

using Notes = std::vector<std::string>;

Notes notes_of(const std::string& model) { return read_mesh_file(std::string(DMPC_MODELS) + "/" + model).notes; }

bool has(const Notes& notes, const std::string& note) { return std::find(notes.begin(), notes.end(), note) != notes.end(); }

Notes notes_of_text(const std::string& name, const std::string& text) { return tests::read_mesh(name, text).notes; }

}  // namespace

TEST_CASE("of a plain mesh nothing but the view is said") { CHECK(notes_of_text("a.gltf", tests::Gltf{}.text()).size() == 1); }

TEST_CASE("a texture whose mesh has no places on it is said") {
  const tests::TemporaryFolder folder;
  apps::write_image(folder / "a.png", apps::Image(1, 1));
  tests::Gltf gltf{.materials = R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])"};
  gltf.more = R"("textures":[{"source":0}],"images":[{"uri":"a.png"}])";
  tests::write_text(folder / "a.gltf", gltf.text());
  CHECK(has(read_mesh_file(folder / "a.gltf").notes, "meshes whose texture is not shown, since no corner has a place on it: 1"));
}

TEST_CASE("what is not shown is said once a kind, with its count") {
  CHECK(
      has(notes_of("glTF2/ClearCoat-glTF/ClearCoatTest.gltf"), "textures not used, since they are not of a surface's colour: 5"));
  CHECK(has(notes_of("glTF2/BoxTexcoords-glTF/boxTexcoords.gltf"),
            "meshes with several sets of texture coordinates, of which colours use one: 1"));
  CHECK(has(notes_of("glTF2/simple_skin/simple_skin.gltf"),
            "meshes with a skin, shown in the pose in which their joints stand: 1"));
  CHECK(has(notes_of("glTF2/simple_skin/simple_skin.gltf"), "animations not played: 1"));
  const Notes cube = notes_of("glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf");
  CHECK(has(cube, "meshes with morph targets, shown without them: 1"));
  const Notes coats = notes_of("glTF2/ClearCoat-glTF/ClearCoatTest.gltf");
  CHECK(has(coats, "materials with a clear coat, shown without it: 6"));
  CHECK(has(coats, "materials whose own light is a texture's, shown without it: 1"));
}

TEST_CASE("glass that colours what shines through it is said, grey glass is not") {
  const auto glass = [](const std::string& color) {
    const tests::Gltf gltf{.materials = R"([{"pbrMetallicRoughness":{"baseColorFactor":)" + color +
                                        R"(},"extensions":{"KHR_materials_transmission":{"transmissionFactor":1}}}])"};
    return has(notes_of_text("a.gltf", gltf.text()), "materials that colour what shines through them, shown without that: 1");
  };
  CHECK(glass("[1,0,0,1]"));
  CHECK(!glass("[0.5,0.5,0.5,1]"));
}

TEST_CASE(
    "a glTF factor that is no share is said, light that is brighter than white is not, and a mode that is none is refused") {
  const auto notes_of = [](const std::string& material) {
    return notes_of_text("a.gltf", tests::Gltf{.materials = "[{" + material + "}]"}.text());
  };
  const std::string said = "materials with factors outside 0 to 1, brought into it: 1";
  for (const char* const beyond :
       {R"("pbrMetallicRoughness":{"baseColorFactor":[2,0,0,1]})", R"("pbrMetallicRoughness":{"metallicFactor":5})",
        R"("pbrMetallicRoughness":{"roughnessFactor":-1})", R"("emissiveFactor":[0,-1,0])",
        R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":2}})"}) {
    CAPTURE(beyond);
    CHECK(has(notes_of(beyond), said));
  }
  CHECK_FALSE(has(notes_of(R"("emissiveFactor":[1,2,1])"), said));
  CHECK_THROWS_WITH_AS(notes_of(R"("alphaMode":"mask")"),
                       doctest::Contains("materials[0].alphaMode: is 'mask', expected OPAQUE, MASK or BLEND"), core::InputError);
}

TEST_CASE("what is cut away altogether is said, and a mask that cuts nothing is not") {
  const auto masked = [](const std::string& alpha) {
    const tests::Gltf gltf{.materials = R"([{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,)" + alpha +
                                        R"(]}},{"alphaMode":"MASK"}])"};
    return notes_of_text("a.gltf", gltf.text());
  };
  CHECK(has(masked("0.25"), "materials cut away altogether by their alpha, whose faces are left out: 1"));
  CHECK(masked("0.5").size() == 1);  // the view
}

}  // namespace dmpc::apps::features_test
