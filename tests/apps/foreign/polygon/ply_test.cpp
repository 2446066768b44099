// PLY in text and in binary, by our own reader.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/foreign/polygon/ply_header.h"
#include "core/base/srgb.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/tables.h"

namespace dmpc::apps::ply_test {

using core::Vec3d;
using tests::check_complaints;
using tests::color_of_object;
using tests::contains;
using tests::mesh_refusal;
using tests::notes;
using tests::read_mesh;
using tests::with;

namespace {

const char* const refusals = "apps/foreign/polygon/refusals.txt";
const std::vector<Vec3d> triangle = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};

/// With these properties of vertices and faces and these bodies of three vertices and of faces.
struct Ply {
  std::string vertex_properties = "property float x\nproperty float y\nproperty float z\n";
  std::string vertices = "0 0 0\n2 0 0\n0 1 0\n";
  std::string face_properties = "property list uchar int vertex_indices\n";
  std::string faces = "3 0 1 2\n";
  std::string more_header, more_body;
  int face_count = 1;

  std::string text() const {
    return "ply\nformat ascii 1.0\nelement vertex 3\n" + vertex_properties + "element face " + std::to_string(face_count) + "\n" +
           face_properties + more_header + "end_header\n" + vertices + faces + more_body;
  }
};

template <class T>
std::string swapped(T value) {
  std::string bytes = tests::bytes_of(value);
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// The triangle in binary, with coordinates of this type.
template <class T>
std::string binary(const std::string& type, bool is_big) {
  std::string file = "ply\nformat " + std::string(is_big ? "binary_big_endian" : "binary_little_endian") +
                     " 1.0\nelement face 1\n" + "property list int16 uint vertex_index\nproperty uint8 flags\nelement vertex 3\n";
  for (const char* name : {"x", "y", "z"}) {
    file += "property " + type + " " + name + "\nproperty list uint8 double unknown_" + name + "\n";
  }
  file += "end_header\n";
  const auto add = [&](auto value) { file += is_big ? swapped(value) : tests::bytes_of(value); };
  add(std::int16_t{3});
  for (const std::uint32_t vertex : {0U, 1U, 2U}) {
    add(vertex);
  }
  add(std::uint8_t{7});
  for (const float corner : tests::triangle_corners) {
    add(static_cast<T>(corner));
    add(std::uint8_t{1});
    add(double{0.5});
  }
  return file;
}

std::string refusal(const std::string& text) { return mesh_refusal("a.ply", text); }

const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

}  // namespace

TEST_CASE("a PLY file is the same in text and in both orders of bytes, of any types, elements in any order") {
  for (const bool is_big : {false, true}) {
    CHECK(read_mesh("a.ply", binary<float>("float", is_big)).scene.vertices == triangle);
    CHECK(read_mesh("a.ply", binary<double>("float64", is_big)).scene.vertices == triangle);
    CHECK(read_mesh("a.ply", binary<std::int8_t>("char", is_big)).scene.vertices == triangle);
    CHECK(read_mesh("a.ply", binary<std::uint16_t>("ushort", is_big)).scene.vertices == triangle);
    CHECK(read_mesh("a.ply", binary<std::int32_t>("int32", is_big)).scene.vertices == triangle);
  }
  CHECK(read_mesh("a.ply", Ply{}.text()).scene.vertices == triangle);
  CHECK(read_mesh("a.ply", with(Ply{}.text(), "2 0 0\n", "2\r\n\r\n0 0 comment\ncomment 9\n")).scene.vertices == triangle);
}

TEST_CASE("coordinates of PLY are doubles in text, whatever type they have, and rounded in binary only where they are floats") {
  const MeshFile file = read_mesh("a.ply", with(Ply{}.text(), "2 0 0", "5412345.25 0 0"));
  CHECK(file.scene.vertices.at(1).x == 5412345.25);
  CHECK(file.scene.coordinate_rounding == 0);
  CHECK(read_mesh("a.ply", binary<double>("double", false)).scene.coordinate_rounding == 0);
  CHECK(read_mesh("a.ply", binary<float>("float", false)).scene.coordinate_rounding == 0x1p-25);
}

TEST_CASE("faces of PLY have their colours, in materials of their own where these are few") {
  const Ply few{.face_properties = colors + "property list uchar int vertex_indices\n",
                .faces = "255 0 0 3 0 1 2\n0 0 255 3 2 1 0\n",
                .face_count = 2};
  const MeshFile file = read_mesh("a.ply", few.text());
  CHECK(color_of_object(file, 0) == Vec3d{1, 0, 0});
  CHECK(color_of_object(file, 1) == Vec3d{0, 0, 1});
  Ply many{.face_properties = few.face_properties, .faces = "", .face_count = 65};
  for (int i = 0; i < many.face_count; ++i) {
    many.faces += std::to_string(i) + " 0 0 3 0 1 2\n";
  }
  const MeshFile spread = read_mesh("a.ply", many.text());
  CHECK(spread.scene.objects.size() == 65);
  CHECK(color_of_object(spread, 0) == Vec3d{0, 0, 0});
  CHECK(color_of_object(spread, 64).x == doctest::Approx(core::linear_from_srgb(64.0 / 255)));
}

TEST_CASE("colours of PLY are a screen's, of the largest number of their type, of floats 1") {
  const std::string list = "property list uchar int vertex_indices\n";
  const auto color = [&](const std::string& type, const std::string& value) {
    std::string properties;
    for (const char* name : {"red", "green", "blue"}) {
      properties += "property " + type + " " + name + "\n";
    }
    const Ply file{.face_properties = list + properties, .faces = "3 0 1 2 " + value + " 0 0\n"};
    return color_of_object(read_mesh("a.ply", file.text()), 0).x;
  };
  CHECK(color("uchar", "128") == doctest::Approx(0.2158605).epsilon(1e-6));
  CHECK(color("ushort", "32896") == doctest::Approx(0.2158605).epsilon(1e-6));
  CHECK(color("float", "0.5") == doctest::Approx(0.2140411).epsilon(1e-6));
  CHECK(color("float", "255") == 1);
}

TEST_CASE("where vertices and faces of PLY have colours the vertices' are shown, and this is said") {
  const Ply both{.vertex_properties = Ply{}.vertex_properties + colors,
                 .vertices = "0 0 0 9 9 9\n2 0 0 9 9 9\n0 1 0 9 9 9\n",
                 .face_properties = Ply{}.face_properties + colors,
                 .faces = "3 0 1 2 255 255 255\n"};
  CHECK(notes(read_mesh("a.ply", both.text()), "colours of faces, which are not shown beside those of vertices: 1"));
}

TEST_CASE("strips of PLY are faces, beside faces") {
  const Ply file{.more_header = "element tristrips 1\nproperty list int int vertex_indices\n",
                 .more_body = "8 0 1 2 2 1 -1 2 1\n"};
  CHECK(read_mesh("a.ply", file.text()).scene.objects.size() == 2);
  const Ply alone{.faces = "", .more_header = file.more_header, .more_body = "4 0 1 2 2\n", .face_count = 0};
  CHECK(read_mesh("a.ply", alone.text()).scene.objects.size() == 1);
}

TEST_CASE("faces of PLY have the materials that they name") {
  const std::string materials =
      "element material 2\nproperty uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\n";
  const Ply file{.face_properties = "property list uchar int vertex_indices\nproperty int material_index\n",
                 .faces = "3 0 1 2 1\n3 0 1 2 0\n",
                 .more_header = materials,
                 .more_body = "255 0 0\n0 255 0\n",
                 .face_count = 2};
  const MeshFile scene = read_mesh("a.ply", file.text());
  CHECK(std::count_if(scene.scene.materials.begin(), scene.scene.materials.end(), [](const core::Material& material) {
          return material.color == Vec3d{0, 1, 0};
        }) == 1);
  CHECK(contains(mesh_refusal("a.ply", with(file.text(), "3 0 1 2 1", "3 0 1 2 5")),
                 "a face has material 5, which does not exist"));
  const Ply none{.face_properties = file.face_properties, .faces = "3 0 1 2 5\n"};
  CHECK(notes(read_mesh("a.ply", none.text()), "faces with a material, of which the file has none: 1"));
}

TEST_CASE("a texture of PLY is looked for, and without coordinates for it that is said") {
  const std::string named = with(Ply{}.text(), "element vertex", "comment TextureFile a b.png\nelement vertex");
  const MeshFile file = read_mesh("a.ply", named, {.allows_missing = true});
  CHECK(notes(file, "textures that are not shown, since the mesh has no texture coordinates: 1"));
  const std::string placed = with(with(named, "property float z\n", "property float z\nproperty float s\nproperty float t\n"),
                                  "0 0 0\n2 0 0\n0 1 0\n", "0 0 0 0 0\n2 0 0 1 0\n0 1 0 0 1\n");
  CHECK(contains(mesh_refusal("a.ply", placed), "a b.png"));
  const std::string wedges = with(with(named, "vertex_indices\n", "vertex_indices\nproperty list uchar float texcoord\n"),
                                  "3 0 1 2\n", "3 0 1 2 6 0 0 1 0 0 1\n");
  check_complaints(refusal, {{wedges, "a b.png"},
                             {with(wedges, "6 0 0 1 0 0 1", "5 0 0 1 0 0"),
                              "face 0 has 5 numbers of texcoord, expected 6, two for each corner"}});
}

TEST_CASE("what of PLY is not shown is said with a count") {
  const Ply file{.vertex_properties = Ply{}.vertex_properties + colors + "property uchar alpha\nproperty float quality\n",
                 .vertices = "0 0 0 9 9 9 255 1\n2 0 0 9 9 9 7 1\n0 1 0 9 9 9 255 1\n",
                 .faces = "3 0 1 2\n2 0 1\n",
                 .more_header = "element edge 2\nproperty int vertex1\nproperty int vertex2\n",
                 .more_body = "0 1\n1 2\nmore\n",
                 .face_count = 2};
  const MeshFile scene = read_mesh("a.ply", with(file.text(), "format", "made by me\nformat"));
  for (const char* what :
       {"points and lines left out: 1", "colours whose alpha is not shown: 1", "elements 'edge', which are not shown: 2",
        "bytes behind the last element, which are not looked at: 5", "which are passed over: 1, such as line 2, 'made by me'"}) {
    CHECK_MESSAGE(notes(scene, what), what);
  }
}

TEST_CASE("properties of PLY that are not shown are said by name, those of faces, too") {
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  const Ply file{.vertex_properties = Ply{}.vertex_properties + "property float quality\n",
                 .vertices = "0 0 0 1\n2 0 0 1\n0 1 0 1\n",
                 .face_properties = Ply{}.face_properties + normals + "property int flags\nproperty int group\n",
                 .faces = "3 0 1 2 0 0 1 2 3\n"};
  const MeshFile scene = read_mesh("a.ply", file.text());
  CHECK(notes(scene, "properties of the element 'vertex' that are not shown ('quality'): 1"));
  CHECK(notes(scene, "properties of the element 'face' that are not shown ('nx', 'ny', 'nz', 'flags' and 1 more): 5"));
  CHECK_FALSE(notes(read_mesh("a.ply", Ply{}.text()), "properties of"));
}

TEST_CASE("elements of PLY may stand in one line, if none of its values is left over") {
  const Ply file{.vertices = "0 0 0 2 0 0\n0 1 0 ", .faces = "3 0 1 2\n"};
  CHECK(read_mesh("a.ply", file.text()).scene.vertices == triangle);
  const Ply wide{.vertices = "0 0 0 0 0 1\n2 0 0 0 0 1\n0 1 0 0 0 1\n"};
  CHECK(contains(mesh_refusal("a.ply", wide.text()), "line 10: found '0', expected no more values of an element"));
}

TEST_CASE("a PLY file may begin with capitals") {
  CHECK(read_mesh("a.ply", with(Ply{}.text(), "ply", "PLY")).scene.vertices == triangle);
}

TEST_CASE("what is wrong in PLY is refused with its line or byte") {
  const std::string whole = Ply{}.text();
  for (const auto& row : tests::rows_in(refusals, 3, "in place of a part of a triangle in PLY")) {
    CHECK_MESSAGE(contains(refusal(with(whole, row[0], row[1])), row[2]), row[1]);
  }
  std::string bytes = binary<float>("float", false);
  bytes.replace(bytes.find("end_header\n") + 13, 1, "\x07");
  check_complaints(refusal, {{bytes, ": face 0 has a vertex that does not exist, 7: there are 3"},
                             {bytes, "a.ply: byte "},
                             {with(with(whole, "face 1", "face 0"), "3 0 1 2\n", ""), "there is no mesh in it"}});
}

TEST_CASE("properties of PLY that mean nothing without others, and colours that are too large, are said") {
  const std::string& plain = tests::triangle_ply;
  const auto with_more = [&](const std::string& properties, const std::string& values) {
    std::string text = with(plain, "property float z\n", "property float z\n" + properties);
    for (const std::string vertex : {"0 0 0\n", "2 0 0\n", "0 1 0\n"}) {
      text = with(text, vertex, vertex.substr(0, vertex.size() - 1) + " " + values + "\n");
    }
    return tests::read_mesh("a.ply", text);
  };
  CHECK(notes(with_more("property uchar red\n", "9"),
              "colours without all of red, green and blue of the element 'vertex', which are not shown: 3"));
  CHECK(notes(with_more("property float nx\n", "1"), "normals without all of nx, ny and nz of the element 'vertex'"));
  CHECK(notes(with_more("property float u\n", "1"), "texture coordinates without both of s and t of the element 'vertex'"));
  const std::string colors = "property short red\nproperty short green\nproperty short blue\n";
  CHECK(notes(with_more(colors, "-5 0 256"), "colours outside 0 to 255, brought into it: 3"));
  CHECK_FALSE(notes(with_more(colors, "0 0 255"), "colours"));
}

TEST_CASE("a PLY file cut within its header is refused at once, wherever it is cut") {
  const std::string header = tests::triangle_ply.substr(0, tests::triangle_ply.find("end_header") + 10);
  for (std::size_t length = 0; length <= header.size(); ++length) {
    CHECK_THROWS_AS(read_ply_header(header.substr(0, length)), core::InputError);
  }
  check_complaints(refusal, tests::complaints_in(refusals, "headers of PLY"));
  read_ply_header("ply\nformat ascii 1.0\nCreated by somebody\ncomment b\nobj_info c\nend_header\n");
}

TEST_CASE("a PLY file cut within its body is refused with what it ends in") {
  const std::string& whole = tests::triangle_ply;
  check_complaints(refusal, {{whole.substr(0, whole.find("3 0 1 2") + 5), "it ends within element 'face' 1 of 1"},
                             {whole.substr(0, whole.find("0 1 0")), "it ends within element 'vertex' 3 of 3"}});
  const std::string bytes = binary<float>("float", true);
  check_complaints(refusal, {{bytes.substr(0, bytes.size() - 1), "it ends within element 'vertex' 3 of 3"},
                             {bytes.substr(0, bytes.find("end_header\n") + 20), "it ends within element 'face' 1 of 1"}});
}

TEST_CASE("what a PLY header promises and its bytes cannot hold is refused before room is made for it") {
  const std::string begin = "ply\nformat binary_little_endian 1.0\n";
  const std::string floats = "property float x\nproperty float y\nproperty float z\n";
  check_complaints(refusal, {{begin + "element vertex 4000000000\n" + floats + "end_header\nabc",
                              "it ends within element 'vertex' 1 of 4000000000"},
                             {begin + "element a 18446744073709551615\nproperty list uint double i\nend_header\n\xff\xff\xff\xff",
                              "it ends within element 'a' 1 of 18446744073709551615"},
                             {begin + "element a 18446744073709551615\nend_header\n", "there is no mesh in it"}});
}

}  // namespace dmpc::apps::ply_test
