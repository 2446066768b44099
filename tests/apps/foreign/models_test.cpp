// The models of Debian's assimp-testmodels: each is a scene, or refused for a reason that is known.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/formats/view_faults.h"
#include "core/base/expect.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/child_process.h"
#include "tests/support/complaint.h"
#include "tests/support/tables.h"

namespace dmpc::apps::models_test {

namespace {

namespace fs = std::filesystem;

/// Models that are refused, and what is said of them.
std::map<std::string, std::string> refused_models() {
  std::map<std::string, std::string> refused;
  for (const auto& row : tests::rows_in("apps/foreign/models.txt", 2)) {
    refused[row[0]] = row[1];
  }
  return refused;
}

std::vector<std::string> models() {
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(DMPC_MODELS)) {
    const std::string path = fs::relative(entry.path(), DMPC_MODELS).generic_string();
    std::string ending = entry.path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    const std::array<std::string, 5> wanted = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    if (entry.is_regular_file() && std::find(wanted.begin(), wanted.end(), ending) != wanted.end()) {
      paths.push_back(path);
    }
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::string model(const std::string& path) { return std::string(DMPC_MODELS) + "/" + path; }

/// Empty if it can be read.
std::string model_complaint(const std::string& path) {
  return tests::complaint_of([&] {
    const MeshFile file = read_mesh_file(model(path), {.allows_missing = true});
    CHECK_FALSE(file.scene.objects.empty());
    CHECK_FALSE(fault_of(file.scene.view));
    CHECK_FALSE(file.scene.lights.empty());
  });
}

std::uint64_t film_of(const std::string& path, Strategy strategy, TracerChoice tracer = TracerChoice::grid) {
  RenderOptions options = small(strategy);
  options.picture.scene = model(path);
  options.picture.resolution = {64, 64};
  options.tracer = tracer;
  return account_of(*Rendered(options).report).film.hash();
}

}  // namespace

TEST_CASE("the models of assimp-testmodels are installed") {
  REQUIRE_MESSAGE(std::string(DMPC_MODELS).find("NOTFOUND") == std::string::npos,
                  "install Debian's package assimp-testmodels, then configure again");
  CHECK(models().size() > 90);
}

TEST_CASE("every model is a scene, or refused for a reason that is known") {
  const std::map<std::string, std::string> refused = refused_models();
  for (const std::string& path : models()) {
    CAPTURE(path);
    const auto reason = refused.find(path);
    CHECK(contains(model_complaint(path), reason == refused.end() ? "" : reason->second));
    CHECK(model_complaint(path).empty() == (reason == refused.end()));
  }
}

TEST_CASE("models give one film in every strategy") {
  for (const char* path : {"OBJ/spider.obj", "PLY/cube_uv.ply", "STL/Spider_binary.stl",
                           "glTF2/ClearCoat-glTF/ClearCoatTest.gltf", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb"}) {
    CAPTURE(path);
    const std::uint64_t film = film_of(path, Strategy::svm);
    CHECK(film == film_of(path, Strategy::dataflow));
    CHECK(film == film_of(path, Strategy::replicated));
  }
}

TEST_CASE("nothing but the closing lines reaches the standard output") {
  tests::ChildProcess quiet({DMPC_PROGRAM, "render", model("OBJ/spider.obj"), "--resolution=8x8", "--quiet", "-o", "/dev/null"});
  CHECK(quiet.status() != 3);
  CHECK(quiet.output().empty());
  tests::ChildProcess bad({DMPC_PROGRAM, "render", model("invalid/malformed.obj"), "-o", "a.png"});
  CHECK(bad.status() == 1);
  CHECK(bad.output().empty());
  CHECK_FALSE(fs::exists("a.png"));
}

}  // namespace dmpc::apps::models_test
