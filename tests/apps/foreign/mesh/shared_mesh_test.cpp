// What stands in several places comes from the reader once, and the scene is that of a file in which each place has a mesh of its
// own.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/foreign/mesh_reader.h"
#include "apps/formats/scene_blocks.h"
#include "tests/fuzz/input_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"
#include "tests/support/same_scene.h"

namespace dmpc::apps::shared_mesh_test {

using tests::Gltf;

namespace {

/// Turned, mirrored, pressed flat, pressed away, stretched, far away, and below one another.
const std::string places =
    R"([{"mesh":M},{"mesh":M,"translation":[0,0,1],"rotation":[0.6,0,0,0.8]},{"mesh":M,"scale":[1,1,-1]},)"
    R"({"mesh":M,"scale":[1,2,0]},{"mesh":M,"scale":[0,0,0]},{"mesh":M,"scale":[-3,0.001,7],"children":[9]},)"
    R"({"mesh":M,"translation":[1e6,-1e6,0.1]},{"mesh":M,"scale":[1e-4,1e-4,1e-4]},{"mesh":M,"scale":[1e4,-1e4,-1e4]},)"
    R"({"mesh":M,"rotation":[0,0.8,0,0.6],"translation":[0.1,0.2,0.3]}])";
const std::string roots = "[0,1,2,3,4,5,6,7,8]";

/// The document with `nodes`, whose n-th M is mesh n, or all of them mesh 0, and as many meshes, which are all alike.
std::string document(const Gltf& gltf, bool is_shared) {
  Gltf placed = gltf;
  placed.roots = roots;
  placed.nodes.clear();
  std::size_t count = 0;
  for (const char c : places) {
    placed.nodes += c == 'M' ? std::to_string(is_shared ? 0 : count) : std::string(1, c);
    count += c == 'M' ? 1 : 0;
  }
  std::string text = placed.text();
  const std::string head = R"("meshes":[)";
  const std::size_t first = text.find(head) + head.size(), end = text.find("}]}]", first) + 3;
  const std::string mesh = text.substr(first, end - first);
  for (std::size_t i = 1; i < count; ++i) {
    text.insert(first, mesh + ",");
  }
  return text;
}

/// As a reader sends it.
MeshScene read(const std::string& text, const MeshOptions& options = {}) {
  fuzz::InputFiles files("a.gltf", std::as_bytes(std::span(text)));
  return read_mesh("a.gltf", options, files);
}

std::uint64_t bytes_sent(MeshScene mesh) {
  auto [mine, its] = make_ends();
  Line sender(std::move(mine)), receiver(std::move(its));
  std::jthread writer([&] {
    send_scene(mesh.scene, mesh.vertices, mesh.instances, sender, Handing::in_messages);
    sender.send(Saying::done);
  });
  std::uint64_t bytes = 0;
  while (true) {
    const std::optional<Message> message = receiver.receive(false);
    bytes += message->bytes.size();
    if (message->saying == Saying::done) {
      return bytes;
    }
  }
}

void check_same(const Gltf& gltf, const MeshOptions& options = {}) {
  const MeshFile shared = tests::read_mesh("a.gltf", document(gltf, true), options);
  const MeshFile apart = tests::read_mesh("a.gltf", document(gltf, false), options);
  CHECK(shared.scene.objects.size() == 9);  // all but what is pressed away
  CHECK(tests::same_scene(shared.scene, apart.scene));
}

/// A bumpy sheet of side x side squares in as many places.
std::string sheet(std::uint32_t side, std::uint32_t count) {
  std::vector<float> points;
  std::vector<std::uint32_t> faces;
  for (std::uint32_t i = 0; i < (side + 1) * (side + 1); ++i) {
    const auto x = static_cast<float>(i % (side + 1)), z = static_cast<float>(i / (side + 1));
    points.insert(points.end(), {x, std::fmod(x * z, 3.0F), z});
  }
  for (std::uint32_t square = 0; square < side * side; ++square) {
    const std::uint32_t a = square / side * (side + 1) + square % side, b = a + side + 1;
    faces.insert(faces.end(), {a, a + 1, b, b, a + 1, b + 1});
  }
  tests::GltfDocument document;
  const std::string positions = document.add(points, 3), indices = document.add(faces, 1);
  std::string children;
  document.node = R"({"children":[)";
  for (std::uint32_t i = 0; i < count; ++i) {
    document.node += (i > 0 ? "," : "") + std::to_string(i + 1);
    children += R"(,{"mesh":0,"translation":[)" + std::to_string(i) + ",0,0]}";
  }
  document.node += "]}" + children;
  return document.text(R"({"attributes":{"POSITION":)" + positions + R"(},"indices":)" + indices + "}");
}

}  // namespace

TEST_CASE("a mesh in several places makes the scene of as many meshes, to the last bit, wherever it is put") {
  check_same({});
  check_same({.normals = {0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 1}});
  check_same({.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1}});
  check_same({.materials = R"([{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.2,0.1,1]}}])"});
  check_same({}, {.scale = 1e-3});
  check_same({.normals = {0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 1}}, {.smooth_degrees = 60});
}

TEST_CASE("a mesh in several places is sent once, but for one that is smoothed where it stands") {
  const MeshScene mesh = read(document({}, true));
  CHECK(mesh.scene.objects.size() == 1);
  CHECK(mesh.instances.meshes.size() == 1);
  CHECK(mesh.instances.places.size() == 9);
  CHECK(read(document({}, false)).instances.empty());
  CHECK(read(document({}, true), {.smooth_degrees = 60}).instances.empty());
}

TEST_CASE("of a thousand places of a mesh of 5,000 triangles the reader sends 500 times fewer bytes than all of them take") {
  const MeshScene mesh = read(sheet(50, 1000));
  core::Scene all = mesh.scene;
  all.vertices = expanded(mesh.vertices);
  core::expand(all, mesh.instances);
  REQUIRE(all.objects.size() == 5'000'000);
  // What was sent: objects, points, and indices of them.
  const std::uint64_t before = sizeof(core::Object) * all.objects.size() + sizeof(std::uint32_t) * all.vertices.size() +
                               sizeof(core::Vec3d) * 1000 * mesh.vertices.points.size();
  CHECK(500 * bytes_sent(mesh) < before);
}

}  // namespace dmpc::apps::shared_mesh_test
