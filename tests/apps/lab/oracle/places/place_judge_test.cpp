#include "apps/lab/oracle/places/place_judge.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/scene/load_scene.h"
#include "tests/support/mesh_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::place_judge_test {
namespace {

using apps::PlaceFindings;
using Change = std::function<void(core::Scene&)>;

/// What the oracle finds of a file whose scene is changed after it was read.
PlaceFindings judged(
    const std::string& path, const Change& change = [](core::Scene&) {}) {
  const apps::PictureOptions picture{.scene = path, .resolution = apps::Resolution{40, 30}};
  apps::OpenedFiles opened;
  core::Scene scene = apps::load_scene(picture, apps::LoadNotes::silent, &opened);
  change(scene);
  return apps::judge_places(scene, picture, opened);
}

PlaceFindings judged_text(
    const std::string& name, const std::string& text, const Change& change = [](core::Scene&) {}) {
  const TemporaryFolder folder;
  write_text(folder / name, text);
  return judged((folder / name).string(), change);
}

/// All pixels see what the file has there.
void check_same(const PlaceFindings& findings) { CHECK(text_of(findings) == "0 of 1,200 pixels see another place"); }

const std::string far_camera = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":1}}])";

/// The triangle a million units off, by two nodes that turn and stretch it, before a camera there.
Gltf far_triangle() {
  return {.nodes = R"([{"mesh":0,"rotation":[0.1,0.2,0.3,0.9273618495495704],"scale":[1,2,-1.5],"translation":[0.3,0.1,0]},)"
                   R"({"children":[0,2],"matrix":[0,0,-1,0, 0,1,0,0, 1,0,0,0, 1000000.1,2000000.2,-3000000.3,1]},)"
                   R"({"camera":0,"translation":[0.8,0.5,6]}])",
          .roots = "[1]",
          .more = far_camera};
}

TEST_CASE("the oracle sees what the readers see, in glTF of every build and in OBJ") {
  check_same(judged_text("a.gltf", far_triangle().text()));
  check_same(judged_text("a.glb", far_triangle().binary()));
  const TemporaryFolder folder;
  write_text(folder / "a.gltf", far_triangle().json("bytes%20here.bin"));
  write_text(folder / "bytes here.bin", far_triangle().bytes());
  check_same(judged((folder / "a.gltf").string()));
  check_same(judged_text("a.gltf", Gltf{.nodes = R"([{"mesh":0},{"mesh":0,"translation":[1,2,0]}])", .roots = "[0,1]"}.text()));
  check_same(judged_text("a.obj", triangle_obj));
  check_same(
      judged_text("a.obj",
                  "\xEF\xBB\xBF# a house\\\r\nv +0 0 0 # corner\rv 2e0 0 0 2 \nv 2 2 \\\r\n 0 1 0 0\nv 0 2 0\nvt 0 0\nvn 0 0 1\n"
                  "f -4/1/1 -3/1/1 3/-1/-1 4/1/1\nf 1 6 5\ng x\nv 0 0 3\nv -1 0 2\n"));
}

TEST_CASE("the oracle sees numbers in every packing, strips and fans") {
  const std::vector<float> square = {0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1.5F, 0.5F, 1, 3, 0};
  for (const int mode : {4, 5, 6}) {
    GltfDocument document;
    const std::string points = document.add(square, 3);
    const std::string primitive = R"({"attributes":{"POSITION":)" + points + R"(},"mode":)" + std::to_string(mode);
    check_same(judged_text("a.gltf", document.text(primitive + "}")));
    const std::string indices = document.add(std::vector<std::uint8_t>{4, 0, 1, 2, 3, 1}, 1);
    check_same(judged_text("a.gltf", document.text(primitive + R"(,"indices":)" + indices + "}")));
  }
  GltfDocument packed;
  const std::string bytes = packed.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, -128, 100, 5}, 3, R"("normalized":true)");
  check_same(judged_text("a.gltf", packed.text(R"({"attributes":{"POSITION":)" + bytes + "}}")));
  GltfDocument sparse;
  const std::size_t places = sparse.view(bytes_of(std::array<std::uint16_t, 2>{1, 2}));
  const std::size_t values = sparse.view(bytes_of(std::array<float, 6>{2, 0, 0, 0, 1, 1}));
  const std::size_t points =
      sparse.accessor(R"("sparse":{"count":2,"indices":{"componentType":5123,"bufferView":)" + std::to_string(places) +
                          R"(},"values":{"bufferView":)" + std::to_string(values) + "}}",
                      5126, 3, "VEC3");
  check_same(judged_text("a.gltf", sparse.text(R"({"attributes":{"POSITION":)" + std::to_string(points) + "}}")));
}

TEST_CASE("the oracle leaves out what is hidden or cut away by its alpha") {
  const std::string other =
      R"([{"mesh":0},{"mesh":0,"translation":[0,0,1],"extensions":{"KHR_node_visibility":{"visible":false}}}])";
  check_same(judged_text("a.gltf", Gltf{.nodes = other, .roots = "[0,1]"}.text()));
  const std::string primitive = R"({"attributes":{"POSITION":0}},{"attributes":{"POSITION":1},"material":0})";
  GltfDocument document;
  document.add(std::vector<float>{0, 0, 0, 2, 0, 0, 0, 1, 0}, 3);
  document.add(std::vector<float>{0, 0, 1, 2, 0, 1, 0, 1, 1}, 3);
  const std::string cut = R"("materials":[{"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.2]}}])";
  check_same(judged_text("a.gltf", document.text(primitive, cut)));
}

TEST_CASE("coordinates that are rounded to float on the way are told in pixels") {
  const PlaceFindings findings = judged_text("a.gltf", far_triangle().text(), [](core::Scene& scene) {
    for (core::Vec3d& vertex : scene.vertices) {
      vertex = core::Vec3d(core::Vec3f(vertex));
    }
  });
  CHECK(findings.elsewhere > 50);
  CHECK(contains(text_of(findings), " of 1,200 pixels see another place (worst in pixel ("));
}

TEST_CASE("a camera beside its place, and a face too many or too few, are told in pixels") {
  const auto elsewhere = [](const Change& change) {
    const PlaceFindings findings = judged_text("a.gltf", far_triangle().text(), change);
    CHECK(contains(findings.worst, "what one of both does not see"));
    return findings.elsewhere;
  };
  CHECK(elsewhere([](core::Scene& scene) { scene.view.from.x += 0.1; }) > 50);
  CHECK(elsewhere([](core::Scene& scene) { scene.view.angle_degrees *= 1.1; }) > 10);
  CHECK(elsewhere([](core::Scene& scene) { scene.objects.clear(); }) > 100);
}

TEST_CASE("what the oracle does not read is not judged, and says why") {
  const auto why = [](const std::string& name, const std::string& text) {
    const PlaceFindings findings = judged_text(name, text);
    CHECK(findings.pixels == 0);
    return text_of(findings);
  };
  CHECK(why("a.ply", triangle_ply) == "not judged: the oracle reads OBJ and glTF alone, and nothing that moves");
  GltfDocument morph;
  const std::string points = morph.add(std::vector<float>{0, 0, 0, 2, 0, 0, 0, 1, 0}, 3);
  CHECK(contains(
      why("a.gltf", morph.text(R"({"attributes":{"POSITION":)" + points + R"(},"targets":[{"POSITION":)" + points + "}]}")),
      "targets"));
  const std::string many = triangle_obj + repeated(1'250'000, "f 1 2 3\n");
  CHECK(contains(why("a.obj", many), "triangles"));
}

TEST_CASE("of a file that changed since it was read, however broken, nothing is judged") {
  const TemporaryFolder folder;
  const std::string path = (folder / "a.gltf").string(), whole = far_triangle().text();
  const std::vector<std::string> broken = {"",
                                           "[]",
                                           "{}",
                                           whole.substr(0, 500),
                                           R"({"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})",
                                           R"({"scenes":[{"nodes":[7]}],"nodes":[]})",
                                           R"({"scenes":[{"nodes":[-1]}],"nodes":[{}]})",
                                           R"({"scenes":{"nodes":3}})",
                                           "glTF",
                                           "glTFxxxxyyyy\xFF\xFF\xFF\xFFJSON{}"};
  for (const std::string& text : broken) {
    CAPTURE(text);
    write_text(path, whole);
    const PlaceFindings findings = judged(path, [&](core::Scene&) { write_text(path, text); });
    CHECK(contains(text_of(findings), "not judged: "));
  }
  for (const char* const number : {"1e300", "-5", "0.5", "99999999999", "null", "\"x\"", "[]"}) {
    for (const char* const key : {R"("count":3)", R"("byteLength":36)", R"("byteOffset":36)", R"("POSITION":0)", R"("indices":2)",
                                  R"("mesh":0)", R"("componentType":5126)", R"("bufferView":0)"}) {
      std::string text = whole;
      const std::string name = std::string(key).substr(0, std::string(key).find(':') + 1);
      text.replace(text.find(key), std::string(key).size(), name + number);
      write_text(path, whole);
      judged(path, [&](core::Scene&) { write_text(path, text); });
    }
  }
}

TEST_CASE("models of others stand where the oracle has them") {
  for (const std::string model :
       {"OBJ/spider.obj", "OBJ/WusonOBJ.obj", "OBJ/concave_polygon.obj", "glTF2/ClearCoat-glTF/ClearCoatTest.gltf",
        "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", "glTF2/BoxTextured-glTF/BoxTextured.gltf"}) {
    CAPTURE(model);
    check_same(judged(DMPC_MODELS "/" + model));
  }
}

}  // namespace
}  // namespace dmpc::tests::place_judge_test
