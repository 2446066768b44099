// STL in text and in binary, by our own reader.

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/srgb.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"
#include "tests/support/tables.h"

namespace dmpc::apps::stl_test {

using core::Vec3d;
using tests::check_complaints;
using tests::color_of_object;
using tests::contains;
using tests::mesh_refusal;
using tests::notes;
using tests::read_mesh;
using tests::with;

namespace {

std::string facet(std::uint16_t attribute) {
  return tests::bytes_of(std::array<float, 3>{0, 0, 1}) + tests::bytes_of(tests::triangle_corners) + tests::bytes_of(attribute);
}

std::string binary(const std::vector<std::uint16_t>& attributes, std::string header = "") {
  header.resize(80, ' ');
  std::string file = header + tests::bytes_of(static_cast<std::uint32_t>(attributes.size()));
  for (const std::uint16_t attribute : attributes) {
    file += facet(attribute);
  }
  return file;
}

std::string refusal(const std::string& text) { return mesh_refusal("a.stl", text); }

}  // namespace

TEST_CASE("words of STL may be in letters of any case, on any lines, and after lines that are empty") {
  const std::string loud =
      "\r\n\n SOLID A Thing\r\nFacet NORMAL 0 0 1 Outer Loop\n vertex 0 0\n 0 VERTEX +2 0e0 0\rvertex 0 1. .0\n"
      "EndLoop ENDFACET\nEndSolid A Thing\r\n";
  CHECK(read_mesh("a.stl", loud).scene.vertices == read_mesh("a.stl", tests::triangle_stl).scene.vertices);
}

TEST_CASE("an STL file in text may have several solids, empty ones, names with blanks, and none") {
  const std::string named = with(tests::triangle_stl, "solid one", "solid a b facet");
  const MeshFile file = read_mesh("a.stl", named + "solid\nendsolid\n" + with(tests::triangle_stl, "solid one\nf", "solid\nf"));
  CHECK(file.scene.objects.size() == 2);
  CHECK(file.notes.size() == 1);
}

TEST_CASE("the normals that STL facets have are not read, be they numbers or not") {
  for (const char* normal : {"1 0 0", "0.31 0.2 0.9", "-nan(ind) nan inf"}) {
    const MeshFile file = read_mesh("a.stl", with(tests::triangle_stl, "0 0 1", normal));
    CHECK(file.scene.objects.at(0).kind == core::ObjectKind::polygon);
  }
}

TEST_CASE("what is wrong in STL text is refused with its line") {
  for (const auto& row : tests::rows_in("apps/foreign/polygon/refusals.txt", 3, "in place of a part of a triangle in STL")) {
    CHECK_MESSAGE(contains(refusal(with(tests::triangle_stl, row[0], row[1])), row[2]), row[1]);
  }
  CHECK(contains(refusal("solid a\nendsolid a\n"), "there is no mesh in it"));
}

TEST_CASE("coordinates in STL text are doubles") {
  const MeshFile file = read_mesh("a.stl", with(tests::triangle_stl, "2 0 0", "5412345.25 0 0"));
  CHECK(file.scene.vertices.at(1).x == 5412345.25);
  CHECK(file.scene.coordinate_rounding == 0);
  CHECK(read_mesh("a.stl", tests::triangle_binary_stl()).scene.coordinate_rounding == 0x1p-25);
}

TEST_CASE("an STL file in binary may begin as one in text does") {
  CHECK(read_mesh("a.stl", binary({0}, "solid one")).scene.objects.size() == 1);
  CHECK(read_mesh("a.stl", binary({0}, "solid one\n facet normal") + "xx").scene.objects.size() == 1);
}

TEST_CASE("bytes behind the last facet of STL are said, and no reason to refuse the file") {
  const MeshFile file = read_mesh("a.stl", binary({0}) + std::string(10, 'x'));
  CHECK(file.scene.objects.size() == 1);
  CHECK(notes(file, "bytes behind the last facet, which are not looked at: 10"));
}

TEST_CASE("what follows the last solid of STL in text is said, and no reason to refuse the file") {
  for (const std::string& behind : {std::string(20, '\0'), std::string("\x1a"), std::string("made by hand\n")}) {
    const MeshFile file = read_mesh("a.stl", tests::triangle_stl + behind);
    CHECK(file.scene.objects.size() == 1);
    CHECK(notes(file, "what follows the last solid is left out"));
  }
}

TEST_CASE("an STL file that counts no facets has those that follow") {
  std::string text = binary({0, 0});
  text.replace(80, 4, std::string(4, '\0'));
  const MeshFile file = read_mesh("a.stl", text);
  CHECK(file.scene.objects.size() == 2);
  CHECK(notes(file, "says that it has no facets; by its length it has these: 2"));
  CHECK(contains(mesh_refusal("a.stl", binary({})), "there is no mesh in it"));
}

TEST_CASE("an STL file that counts more facets than it has bytes for is refused before room is made for them") {
  std::string text = binary({0});
  text.replace(80, 4, std::string(4, '\xff'));
  CHECK(contains(mesh_refusal("a.stl", text), "it has room for 1 facets, and says that it has 4294967295"));
}

TEST_CASE("facets of STL have the colours of their attributes, as VisCAM and as Magics write them") {
  constexpr double half = 15.0 / 31;
  const double light = static_cast<double>(static_cast<float>(core::linear_from_srgb(half)));
  const MeshFile viscam = read_mesh("a.stl", binary({0x8000U | 31U << 10U, 0x8000U | 15U << 5U, 31}));
  CHECK(notes(viscam, "facets that have the colour of their attribute: 2"));
  CHECK(color_of_object(viscam, 0) == Vec3d{1, 0, 0});
  const MeshFile magics = read_mesh("a.stl", binary({15U << 5U}, "COLOR=\xff\x01\xff\xff"));
  CHECK(color_of_object(magics, 0).y == doctest::Approx(light).epsilon(1e-6));
  CHECK(color_of_object(magics, 0).x == 0);
}

TEST_CASE("a colour of all facets of STL is one for a screen") {
  const MeshFile file = read_mesh("a.stl", binary({0}, std::string("COLOR=\x80\x00\xff\xff", 10)));
  CHECK(color_of_object(file, 0).x == doctest::Approx(0.2158605).epsilon(1e-6));
  CHECK(color_of_object(file, 0).y == 0);
  CHECK(color_of_object(file, 0).z == 1);
}

TEST_CASE("an STL file cut short is refused, in text and in binary") {
  const std::string &text = tests::triangle_stl, binary = tests::triangle_binary_stl();
  check_complaints(refusal, {{text.substr(0, text.find("endloop")), "cut short, expected 'endloop'"},
                             {text.substr(0, text.find("endfacet")), "cut short, expected 'endfacet'"},
                             {text.substr(0, text.find("endsolid")), "cut short, expected 'facet'"},
                             {binary.substr(0, 120), "it has room for 0 facets, and says that it has 1"},
                             {binary.substr(0, 50), "is no STL"}});
}

}  // namespace dmpc::apps::stl_test
