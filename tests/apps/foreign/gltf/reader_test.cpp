// The reader of glTF: the same numbers in every packing are the same scene, and what does not hold together is refused.

#include "apps/foreign/gltf/reader.h"

#include <doctest/doctest.h>
#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "core/base/expect.h"
#include "tests/fuzz/input_files.h"
#include "tests/support/packed_gltf.h"
#include "tests/support/read_mesh.h"
#include "tests/support/tables.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::reader_test {

namespace {

using apps::MeshFile;
using core::Scene;
using core::Vec3d;

/// A bent quad of whole numbers.
constexpr std::array<float, 12> corners = {0, 0, 0, 100, 0, -3, 100, 50, 7, -20, 50, 0};
constexpr std::array<std::uint16_t, 6> triangles = {0, 1, 2, 0, 2, 3};

template <class T>
std::string row(const std::vector<T>& values) {
  std::string bytes;
  for (const T& value : values) {
    bytes += bytes_of(value);
  }
  return bytes;
}

template <class T>
std::vector<T> corners_as() {
  return std::vector<T>(corners.begin(), corners.end());
}

MeshFile scene_of(const std::string& text) { return read_mesh("a.gltf", text); }

std::string complaint_about(const std::string& text) { return mesh_refusal("a.gltf", text); }

std::string primitive_of(const std::string& positions, const std::string& indices = "", const std::string& more = "") {
  return R"({"attributes":{"POSITION":)" + positions + (more.empty() ? "" : "," + more) + "}" +
         (indices.empty() ? "" : R"(,"indices":)" + indices) + "}";
}

/// The quad with whatever positions `add` puts into the document.
std::string quad(const std::function<std::string(GltfDocument&)>& add) {
  GltfDocument document;
  const std::string positions = add(document);
  return document.text(primitive_of(positions, document.add(triangles, 1)));
}

std::string plain_quad() {
  return quad([](GltfDocument& document) { return document.add(corners, 3); });
}

std::string packed_vertices(const std::string& rows, std::size_t stride) {
  std::string packed(meshopt_encodeVertexBufferBound(rows.size() / stride, stride), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), rows.data(),
                                           rows.size() / stride, stride));
  return packed;
}

std::string packed_triangles() {
  std::string packed(meshopt_encodeIndexBufferBound(6, 4), '\0');
  packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), triangles.data(), 6));
  return packed;
}

void check_same(const Scene& scene, const Scene& plain) {
  REQUIRE(scene.objects.size() == plain.objects.size());
  CHECK(scene.vertices == plain.vertices);
  CHECK(scene.normals == plain.normals);
}

/// Reads from memory; empty unless it is refused as bad input.
std::string complaint_of_bytes(const std::string& bytes) {
  fuzz::InputFiles files("a.gltf", std::as_bytes(std::span(bytes)));
  return complaint_of([&] { apps::gltf::read_gltf("a.gltf", {}, files); });
}

}  // namespace

TEST_CASE("positions in small integers are the floats that they stand for") {
  const Scene plain = scene_of(plain_quad()).scene;
  REQUIRE(plain.vertices.size() == 6);
  const auto scene_as = [](const auto& numbers) {
    return scene_of(quad([&](GltfDocument& document) { return document.add(numbers, 3); })).scene;
  };
  check_same(scene_as(corners_as<std::int16_t>()), plain);
  check_same(scene_as(corners_as<std::int8_t>()), plain);
}

TEST_CASE("normalised integers reach from -1 to 1, the least of them no further") {
  const std::vector<std::int16_t> integers = {-32768, 0, 0, 32767, 0, 0, 1, 16384, 0, -32767, 5, 9};
  std::vector<float> floats;
  for (const std::int16_t value : integers) {
    floats.push_back(std::max(static_cast<float>(value) / 32767.0F, -1.0F));
  }
  const auto scene_as = [](const auto& numbers, const std::string& more) {
    return scene_of(quad([&](GltfDocument& document) { return document.add(numbers, 3, more); })).scene;
  };
  const Scene packed = scene_as(integers, R"("normalized":true)");
  check_same(packed, scene_as(floats, ""));
  CHECK(packed.vertices[0].x == -1);
  CHECK(packed.vertices[1].x == 1);
}

TEST_CASE("normals in bytes, four to a vertex, are those that they stand for") {
  const auto with_normals = [](int type, const std::string& bytes, const std::string& stride, const std::string& more) {
    GltfDocument document;
    const std::string positions = document.add(corners, 3), indices = document.add(triangles, 1);
    const std::size_t normals = document.accessor(document.view(bytes, stride), type, 4, "VEC3", more);
    return scene_of(document.text(primitive_of(positions, indices, R"("NORMAL":)" + std::to_string(normals)))).scene;
  };
  const std::vector<std::int8_t> packed = {0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 0, 64, 64, -128, 0};
  std::vector<float> floats;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    if (i % 4 != 3) {
      floats.push_back(std::max(static_cast<float>(packed[i]) / 127.0F, -1.0F));
    }
  }
  const Scene plain = with_normals(5126, row(floats), "", "");
  CHECK(plain.normals.size() == 6);
  check_same(with_normals(5120, row(packed), R"("byteStride":4)", R"("normalized":true)"), plain);
}

TEST_CASE("what meshoptimizer packed is what was packed") {
  const Scene plain = scene_of(plain_quad()).scene;
  GltfDocument document;
  const std::size_t vertices = document.packed_view(packed_vertices(bytes_of(corners), 12), 12, 4, "ATTRIBUTES");
  const std::size_t lists = document.packed_view(packed_triangles(), 2, 6, "TRIANGLES");
  const std::string primitive = primitive_of(std::to_string(document.accessor(vertices, 5126, 4, "VEC3")),
                                             std::to_string(document.accessor(lists, 5123, 6, "SCALAR")));
  const Scene scene = scene_of(document.text(primitive, R"("extensionsRequired":["EXT_meshopt_compression"])")).scene;
  REQUIRE(scene.vertices.size() == 6);  // triangles come turned, and in their own order of corners
  for (const Vec3d& vertex : plain.vertices) {
    CHECK(std::count(scene.vertices.begin(), scene.vertices.end(), vertex) ==
          std::count(plain.vertices.begin(), plain.vertices.end(), vertex));
  }
  std::string packed(meshopt_encodeIndexSequenceBound(6, 4), '\0');
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()), packed.size(), triangles.data(), 6));
  std::array<float, 12> exponents{};
  meshopt_encodeFilterExp(exponents.data(), 4, 12, 15, corners.data());
  GltfDocument filtered;
  const std::size_t sequence = filtered.packed_view(packed, 2, 6, "INDICES");
  const std::size_t rows = filtered.packed_view(packed_vertices(bytes_of(exponents), 12), 12, 4, "ATTRIBUTES", "EXPONENTIAL");
  const std::string places = std::to_string(filtered.accessor(rows, 5126, 4, "VEC3"));
  const std::string order = std::to_string(filtered.accessor(sequence, 5123, 6, "SCALAR"));
  check_same(scene_of(filtered.text(primitive_of(places, order))).scene, plain);
}

TEST_CASE("sparse, interleaved and offset accessors are the plain ones that they stand for") {
  const Scene plain = scene_of(plain_quad()).scene;
  const auto sparse = [](GltfDocument& document, const std::string& base, const std::vector<std::uint8_t>& places,
                         const std::vector<float>& values) {
    const std::size_t indices = document.view(row(places)), numbers = document.view(row(values));
    const std::string members = base + R"("sparse":{"count":)" + std::to_string(places.size()) + R"(,"indices":{"bufferView":)" +
                                std::to_string(indices) + R"(,"componentType":5121},"values":{"bufferView":)" +
                                std::to_string(numbers) + "}}";
    return std::to_string(document.accessor(members, 5126, 4, "VEC3"));
  };
  check_same(scene_of(quad([&](GltfDocument& document) {  // the first corner is the zeros that a missing view means
               return sparse(document, "", {1, 2, 3}, {100, 0, -3, 100, 50, 7, -20, 50, 0});
             }))
                 .scene,
             plain);
  check_same(scene_of(quad([&](GltfDocument& document) {
               std::array<float, 12> wrong = corners;
               wrong[6] = 1e6F;
               const std::size_t view = document.view(bytes_of(wrong));
               return sparse(document, R"("bufferView":)" + std::to_string(view) + ",", {2}, {100, 50, 7});
             })).scene,
             plain);
  check_same(scene_of(quad([](GltfDocument& document) {
               std::string rows = "12345678";
               for (std::size_t i = 0; i < corners.size(); i += 3) {
                 rows += row<float>({corners[i], corners[i + 1], corners[i + 2]}) + "12345678";
               }
               const std::size_t view = document.view(rows, R"("byteStride":20)");
               return std::to_string(document.accessor(view, 5126, 4, "VEC3", R"("byteOffset":8)"));
             })).scene,
             plain);
}

/// The quad, its vertices red by words that the packed bytes do not call shares of the largest.
std::string packed_quad() {
  draco::Mesh mesh;
  mesh.set_num_points(4);
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
  draco::GeometryAttribute place, color;
  place.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  color.Init(draco::GeometryAttribute::COLOR, nullptr, 3, draco::DT_UINT16, false, 6, 0);
  draco::PointAttribute* const places = mesh.attribute(mesh.AddAttribute(place, true, 4));
  draco::PointAttribute* const colors = mesh.attribute(mesh.AddAttribute(color, true, 4));
  constexpr std::array<std::uint16_t, 3> red{65535, 0, 0};
  for (std::uint32_t i = 0; i < 4; ++i) {
    places->SetAttributeValue(draco::AttributeValueIndex(i), &corners[3 * i]);
    colors->SetAttributeValue(draco::AttributeValueIndex(i), red.data());
  }
  draco::EncoderBuffer packed;
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);  // keeps the order
  REQUIRE(encoder.EncodeMeshToBuffer(mesh, &packed).ok());
  return {packed.data(), packed.size()};
}

/// A document of these packed bytes: places, and colours if asked for.
std::string draco_document(const std::string& bytes, bool has_colors) {
  GltfDocument document;
  const std::size_t positions = document.accessor("", 5126, 4, "VEC3"), indices = document.accessor("", 5123, 6, "SCALAR"),
                    colors = document.accessor(R"("normalized":true)", 5123, 4, "VEC3");
  return document.text(R"({"attributes":{"POSITION":)" + std::to_string(positions) +
                           (has_colors ? R"(,"COLOR_0":)" + std::to_string(colors) : "") + R"(},"indices":)" +
                           std::to_string(indices) + R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" +
                           std::to_string(document.view(bytes)) + R"(,"attributes":{"POSITION":0)" +
                           (has_colors ? R"(,"COLOR_0":1)" : "") + "}}}}",
                       R"("extensionsRequired":["KHR_draco_mesh_compression"])");
}

TEST_CASE("a mesh packed by Draco is the mesh that was packed") {
  const std::string bytes = packed_quad();
  check_same(scene_of(draco_document(bytes, false)).scene, scene_of(plain_quad()).scene);
  CHECK(contains(complaint_about(draco_document(bytes.substr(0, bytes.size() / 2), false)), "Draco cannot unpack it"));
}

TEST_CASE("colours packed by Draco are shares of the largest number, whether or not the packed bytes say so") {
  const core::Scene scene = scene_of(draco_document(packed_quad(), true)).scene;
  CHECK(scene.materials.at(scene.objects.at(0).material).color == core::Vec3d{1, 0, 0});
  CHECK(scene.objects.at(0).kind == core::ObjectKind::polygon);
}

TEST_CASE("bytes in letters and percents of an address are those that they stand for") {
  const std::string plain = plain_quad();
  const std::size_t begin = plain.find(";base64,"), end = plain.find('"', begin);
  std::string percents, bytes = bytes_of(corners) + bytes_of(triangles);
  for (const char byte : bytes) {
    const auto code = static_cast<unsigned char>(byte);
    constexpr const char* digits = "0123456789abCDEF";
    percents += byte == 'B' ? std::string("B") : std::string{'%', digits[code / 16], digits[code % 16]};
  }
  const std::string text = plain.substr(0, begin) + ";charset=utf-8," + percents + plain.substr(end);
  check_same(scene_of(text).scene, scene_of(plain).scene);
}

TEST_CASE("an index of a vertex that does not exist is refused, with its place") {
  GltfDocument document;
  const std::string positions = document.add(corners, 3);
  const std::string indices = document.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 9}, 1);
  CHECK(contains(complaint_about(document.text(primitive_of(positions, indices))),
                 "a.gltf: meshes[0].primitives[0]: index 5 is of vertex 9, which does not exist: there are 4"));
}

TEST_CASE("what reaches beyond its bytes or does not exist is refused, with its place") {
  const std::string plain = plain_quad();
  CHECK(complaint_of_bytes(plain).empty());
  for (const auto& row : rows_in("apps/foreign/gltf/faults.txt", 3)) {
    CAPTURE(row[1]);
    REQUIRE(contains(plain, row[0]));
    CHECK(contains(complaint_of_bytes(with(plain, row[0], row[1])), row[2]));
  }
}

TEST_CASE("extensions within each other are refused soon, however many") {
  std::string nested = "{}";
  for (int i = 0; i < 2000; ++i) {
    nested = R"({"extensions":)" + nested + "}";
  }
  tests::Gltf gltf;
  gltf.materials = "[" + nested + "]";
  CHECK(tests::contains(complaint_about(gltf.text()), "within each other more than 16 deep"));
}

TEST_CASE("packed bytes that are damaged are refused") {
  const auto complaint = [](const std::string& bytes, std::size_t stride, std::size_t count, const std::string& mode,
                            const std::string& filter = "NONE") {
    GltfDocument document;
    const std::size_t view = document.packed_view(bytes, stride, count, mode, filter);
    return complaint_of_bytes(document.text(primitive_of(std::to_string(document.accessor(view, 5126, 4, "VEC3")))));
  };
  const std::string packed = packed_vertices(bytes_of(corners), 12);
  CHECK(complaint(packed, 12, 4, "ATTRIBUTES").empty());
  CHECK(contains(complaint(packed.substr(0, packed.size() / 2), 12, 4, "ATTRIBUTES"), "damaged"));
  CHECK(contains(complaint(packed, 12, 4'000'000'000, "ATTRIBUTES"), "bytes hold"));
  CHECK(contains(complaint(packed, 11, 4, "ATTRIBUTES"), "do not go together"));
  CHECK(contains(complaint(packed, 12, 4, "ATTRIBUTES", "OCTAHEDRAL"), "do not go together"));
  CHECK(contains(complaint(packed, 12, 4, "PAPER"), "expected ATTRIBUTES"));
}

TEST_CASE("a file cut short anywhere is refused, and one with any byte changed is read or refused") {
  const std::string binary = Gltf{}.binary(), text = plain_quad();
  for (std::size_t length = 0; length < binary.size(); ++length) {
    CHECK_FALSE(complaint_of_bytes(binary.substr(0, length)).empty());
  }
  for (std::size_t length = 0; length < text.size(); ++length) {
    CHECK_FALSE(complaint_of_bytes(text.substr(0, length)).empty());
  }
  std::mt19937 random(1);
  for (int i = 0; i < 3000; ++i) {
    std::string changed = i % 2 == 0 ? binary : text;
    for (int k = 0; k < 1 + i % 3; ++k) {
      changed[random() % changed.size()] = static_cast<char>(random());
    }
    complaint_of_bytes(changed);  // neither throws anything else nor crashes
  }
}

TEST_CASE("what a file requires and is not shown is refused by all its names, what it merely uses is said") {
  GltfDocument document;
  const std::string primitive = R"({"material":0,"mode":5,"attributes":{"POSITION":)" + document.add(corners, 3) + "}}";
  const std::string unlit = R"("materials":[{"extensions":{"KHR_materials_unlit":{}}}])";
  const std::string refusal =
      complaint_about(document.text(primitive, R"("extensionsRequired":["ACME_fog","KHR_materials_unlit"],)" + unlit));
  CHECK(contains(refusal, "requires what is not shown here: ACME_fog, KHR_materials_unlit"));
  const MeshFile used = scene_of(document.text(primitive, R"("extensionsUsed":["ACME_fog","KHR_materials_unlit"],)" + unlit));
  CHECK(notes(used, "unlit materials, shown in the light: 1"));
  CHECK(notes(used, "extensions of glTF that are not shown: ACME_fog"));
}

TEST_CASE("corners that no triangle takes are counted") {
  GltfDocument document;
  const std::string positions = document.add(corners, 3);
  const MeshFile file = scene_of(document.text(primitive_of(positions)));
  CHECK(file.scene.objects.size() == 1);
  CHECK(notes(file, "left over at the ends of lists of triangles, left out: 1"));
}

TEST_CASE("instances stand where their attributes say, and hidden nodes are not shown") {
  GltfDocument document;
  const std::size_t positions = document.accessor(document.view(bytes_of(corners)), 5126, 3, "VEC3");
  const std::string moves = document.add(std::vector<float>{0, 0, 1, 0, 0, 2}, 3);
  document.node = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" + moves +
                  R"(}}},"children":[1]},{"mesh":0,"extensions":{"KHR_node_visibility":{"visible":false}}})";
  const Scene scene = scene_of(document.text(primitive_of(std::to_string(positions)))).scene;
  REQUIRE(scene.objects.size() == 2);
  CHECK(scene.vertices[0] == Vec3d{0, 0, 1});
  CHECK(scene.vertices[3] == Vec3d{0, 0, 2});
}

TEST_CASE("transforms of nodes that are none are refused by their place") {
  const auto refusal_of = [](const std::string& member) {
    return mesh_refusal("a.gltf", Gltf{.nodes = R"([{"mesh":0,)" + member + "}]"}.text());
  };
  const std::string matrix = R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1])";
  check_complaints(refusal_of,
                   {{R"("rotation":[0,0,0,2])", "nodes[0]: a rotation is a quaternion of length 2, expected one of length 1"},
                    {R"("rotation":[0,0,0,0])", "of length 0"},
                    {matrix + R"(,"scale":[2,2,2])", "nodes[0]: has a matrix beside a translation, rotation or scale"},
                    {R"("matrix":[1,0,0,0.5,0,1,0,0,0,0,1,0,0,0,0,1])", "nodes[0].matrix: expected 0, 0, 0 and 1 for"},
                    {matrix, ""},
                    {R"("rotation":[0.7071,0,0,0.7071])", ""}});
}

TEST_CASE("a skin of a mesh without joints and weights holds nothing, which is said") {
  const Gltf gltf{.nodes = R"([{"mesh":0,"skin":0},{}])", .roots = "[0,1]", .more = R"("skins":[{"joints":[1]}])"};
  CHECK(notes(read_mesh("a.gltf", gltf.text()),
              "meshes with a skin and without joints and weights, shown where their node stands: 1"));
}

}  // namespace dmpc::tests::reader_test
