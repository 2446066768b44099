// Files whose meshes stand in several places: kept once they show what their copies show, whatever format says so.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/run/report.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/pbrt_scenes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::instanced_files_test {

namespace {

constexpr std::uint32_t sheet_side = 6;  // 72 triangles, more than are copied

std::uint32_t corner_of(std::uint32_t square, std::uint32_t corner) {
  return square / sheet_side * (sheet_side + 1) + square % sheet_side + corner % 2 + corner / 2 * (sheet_side + 1);
}

/// The points of a bumpy sheet between -1 and 1, and its triangles' corners.
std::pair<std::vector<float>, std::vector<std::uint32_t>> sheet() {
  std::vector<float> points;
  std::vector<std::uint32_t> corners;
  for (std::uint32_t i = 0; i < (sheet_side + 1) * (sheet_side + 1); ++i) {
    const auto x = static_cast<float>(i % (sheet_side + 1)), z = static_cast<float>(i / (sheet_side + 1));
    for (const float number : {x / 3 - 1, std::fmod(x * z, 3.0F) / 4, z / 3 - 1}) {
      points.push_back(number);
    }
  }
  for (std::uint32_t square = 0; square < sheet_side * sheet_side; ++square) {
    for (const std::uint32_t corner : {0U, 2U, 1U, 1U, 2U, 3U}) {
      corners.push_back(corner_of(square, corner));
    }
  }
  return {points, corners};
}

template <class T>
std::string listed(const std::vector<T>& numbers) {
  std::string text;
  for (const T number : numbers) {
    text += std::to_string(number) + " ";
  }
  return text;
}

constexpr const char* places[] = {R"("translation":[0,0,0])", R"("translation":[1,0.3,-2],"rotation":[0.6,0,0,0.8])",
                                  R"("translation":[-1,0.2,-1],"scale":[1,1,-0.5])"};

/// The sheet in three places, by nodes or by one node's instances.
std::string gltf_sheets(bool are_instances) {
  const auto [points, corners] = sheet();
  tests::GltfDocument document;
  const std::string positions = document.add(points, 3), indices = document.add(corners, 1);
  if (are_instances) {
    using Floats = std::vector<float>;
    const std::string moves = document.add(Floats{0, 0, 0, 1, 0.3F, -2, -1, 0.2F, -1}, 3);
    const std::string turns = document.add(Floats{0, 0, 0, 1, 0.6F, 0, 0, 0.8F, 0, 0, 0, 1}, 4);
    const std::string sizes = document.add(Floats{1, 1, 1, 1, 1, 1, 1, 1, -0.5F}, 3);
    document.node = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" + moves +
                    R"(,"ROTATION":)" + turns + R"(,"SCALE":)" + sizes + "}}}}";
  } else {
    document.node = R"({"children":[1,2,3]})";
    for (const char* const place : places) {
      document.node += std::string(R"(,{"mesh":0,)") + place + "}";
    }
  }
  return document.text(R"({"attributes":{"POSITION":)" + positions + R"(},"indices":)" + indices + "}");
}

std::string pbrt_sheets() {
  const auto [points, corners] = sheet();
  return tests::pbrt_camera + "LightSource \"distant\" \"point3 from\" [3 5 10] \"point3 to\" [0 0 0]\n" +
         "ObjectBegin \"o\" Shape \"trianglemesh\" \"point3 P\" [" + listed(points) + "] \"integer indices\" [" +
         listed(corners) + "]\nObjectEnd\nObjectInstance \"o\"\nTranslate 1 2 -1 Rotate 50 1 2 3 ObjectInstance \"o\"\n" +
         "Translate -3 0 0 Scale 1 -1 0.3 ObjectInstance \"o\"\n";
}

struct Shown {
  std::uint64_t film, hits, instances;
};

Shown shown(const std::string& scene, bool keeps) {
  RenderOptions options = small(Strategy::svm);
  options.picture.scene = scene;
  options.picture.resolution = {48, 48};
  options.picture.scene_setup.mesh.copies = core::Copies::left_out;
  options.database.build.structure = core::Structure::extents;
  options.database.build.keeps_instances = keeps;
  const Rendered rendered(options);
  const Account account = account_of(*rendered.report);
  return {account.film.hash(), account.operations.primary_hits, rendered.database.records().instances};
}

/// The film equals that of copies, and `instances` instances are kept.
void check_kept(const std::string& scene, std::uint64_t instances) {
  CAPTURE(scene);
  const Shown copies = shown(scene, false), kept = shown(scene, true);
  CHECK(kept.film == copies.film);
  CHECK(kept.hits > 0);
  CHECK(kept.instances == instances);
  CHECK(copies.instances == 0);
}

}  // namespace

TEST_CASE("nodes that share a mesh, instances of a node, and objects of pbrt show kept once what their copies show") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "nodes.gltf", gltf_sheets(false));
  tests::write_text(folder / "instances.gltf", gltf_sheets(true));
  tests::write_text(folder / "objects.pbrt", pbrt_sheets());
  for (const char* const name : {"nodes.gltf", "instances.gltf", "objects.pbrt"}) {
    check_kept((folder / name).string(), 3);
  }
}

TEST_CASE("an object that pbrt's statements press flat, away or far smaller is copied there, and shows the same") {
  const tests::TemporaryFolder folder;
  for (const char* const odd :
       {"Scale 1 1 0", "Scale 0 0 0", "Scale 1e-30 1e-30 1e-30", "ConcatTransform [1 1 1 0 1 1 1 0 1 1 1 0 0 0 0 1]"}) {
    tests::write_text(folder / "odd.pbrt", pbrt_sheets() + "Identity Translate 0 1.5 1 " + odd + " ObjectInstance \"o\"\n");
    CAPTURE(odd);
    check_kept((folder / "odd.pbrt").string(), 3);
  }
}

TEST_CASE("models of assimp-testmodels whose meshes stand in several places show kept once what their copies show") {
  const std::string models = DMPC_MODELS;
  check_kept(models + "/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 60);
  check_kept(models + "/glTF2/draco/2CylinderEngine.gltf", 60);
}

}  // namespace dmpc::apps::instanced_files_test
