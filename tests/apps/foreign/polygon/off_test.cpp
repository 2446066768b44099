// OFF, by our own reader.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/read_mesh.h"
#include "tests/support/tables.h"

namespace dmpc::apps::off_test {

using core::Vec3d;
using tests::check_complaints;
using tests::color_of_object;
using tests::contains;
using tests::mesh_refusal;
using tests::notes;
using tests::read_mesh;

namespace {

const std::string vertices = "0 0 0\n2 0 0\n0 1 0\n";
const std::vector<Vec3d> triangle = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};

const std::string one_face = "OFF\n3 1 0\n" + vertices;

std::string refusal(const std::string& text) { return mesh_refusal("a.off", text); }

MeshFile read_face(const std::string& face) { return read_mesh("a.off", one_face + face); }

}  // namespace

TEST_CASE("an OFF file may count behind its first word, leave edges and that word out, and have remarks anywhere") {
  for (const std::string begin :
       {"OFF\n3 1 0\n", "OFF 3 1 0\n", "OFF3 1 0\n", "OFF # a\n\n# b\n 3 1\n", "3 1 0\n", "\xef\xbb\xbfOFF\r\n3 1 0\r\n"}) {
    CAPTURE(begin);
    const MeshFile file = read_mesh("a.off", begin + "0 0 0 # the first\n2 0\n0\n# c\n0 1 0\n#d\n3 0 1 2#e\n# end");
    CHECK(file.scene.vertices == triangle);
    CHECK(file.notes.size() == 1);
  }
}

TEST_CASE("a face of OFF has its colour, of 255 or of 1, and with alpha, which is said") {
  CHECK(color_of_object(read_face("3 0 1 2 255 0 0\n"), 0) == Vec3d{1, 0, 0});
  CHECK(color_of_object(read_face("3 0 1 2 0 1 0\n"), 0) == Vec3d{0, 1, 0});
  CHECK(color_of_object(read_face("3 0 1 2 0.0 0.0 1.0 1.0\n"), 0) == Vec3d{0, 0, 1});
  CHECK(color_of_object(read_face("3 0 1 2 0 188 0 128\n"), 0).y == doctest::Approx(0.502886).epsilon(1e-5));
  CHECK(notes(read_face("3 0 1 2 0 188 0 128\n"), "colours whose alpha is not shown: 1"));
  CHECK(notes(read_face("3 0 1 2 7\n"), "colours by their number in a map, which are not shown: 1"));
}

TEST_CASE("faces of OFF of few colours have materials, those without one stay grey") {
  const MeshFile file = read_mesh("a.off", "OFF\n4 2 0\n" + vertices + "0 0 1\n3 0 1 2 255 0 0\n3 0 1 3\n");
  CHECK(color_of_object(file, 0) == Vec3d{1, 0, 0});
  CHECK(color_of_object(file, 1).x == doctest::Approx(0.6));
}

TEST_CASE("where vertices and faces of OFF have colours the vertices' are shown, and this is said") {
  const MeshFile file = read_mesh("a.off", "COFF 3 1\n0 0 0 9 9 9 255\n2 0 0 9 9 9 255\n0 1 0 9 9 9 255\n3 0 1 2 1 0 0\n");
  CHECK(notes(file, "colours of faces, which are not shown beside those of vertices: 1"));
}

TEST_CASE("normals of NOFF are shown, texture coordinates of STOFF are not, of which OFF names no texture") {
  const std::string text = "STNOFF 3 1 0\n0 0 0 0 0 1 0 0\n2 0 0 0 1 1 1 0\n0 1 0 0 0 1 0 1\n3 0 1 2\n";
  const MeshFile file = read_mesh("a.off", text);
  CHECK(file.scene.objects.at(0).kind == core::ObjectKind::patch);
}

TEST_CASE("what is wrong in OFF, in binary or of other dimensions is refused by name, with its line") {
  check_complaints(refusal, tests::complaints_in("apps/foreign/polygon/refusals.txt", "OFF"));
}

TEST_CASE("points and lines of OFF, and what stands behind its last face, are said") {
  const MeshFile file = read_mesh("a.off", "OFF\n3 3 0\n" + vertices + "1 0\n3 0 1 2\n2 0 1\nmore");
  CHECK(file.scene.objects.size() == 1);
  CHECK(notes(file, "points and lines left out: 2"));
  CHECK(notes(file, "bytes behind the last face, which are not looked at: 4"));
}

TEST_CASE("what is no number in OFF and PLY is left out and said where no face has it, else refused with its vertex") {
  const std::string more = "nan nan nan\n", face = "3 0 1 2\n";
  const MeshFile off = read_mesh("a.off", "OFF\n4 1 0\n" + vertices + more + face);
  CHECK(off.scene.vertices == triangle);
  const std::string note =
      "vertices that are no numbers or beyond 1e30, left out as no face has them (the first: the mesh: vertex 3): 1";
  CHECK(notes(off, note));
  CHECK(contains(mesh_refusal("a.off", "OFF\n4 1 0\n" + vertices + more + "3 0 1 3\n"), "the mesh: vertex 3 has a coordinate"));
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(notes(read_mesh("a.ply", header + vertices + more + face), note));
  CHECK(contains(mesh_refusal("a.ply", header + vertices + more + "3 0 1 3\n"), "the mesh: vertex 3 has a coordinate"));
}

TEST_CASE("a colour of OFF that is no number is shown as 0 there, and said with its line") {
  const MeshFile file = read_mesh("a.off", "OFF\n3 1 0\n" + vertices + "3 0 1 2 nan 1 -1.#IND\n");
  CHECK(file.scene.materials.front().color == core::Vec3d{0, 1, 0});
  CHECK(notes(file, "channels of colours that are no numbers, shown as 0 (the first in line 6): 2"));
}

TEST_CASE("a hole in OFF or PLY is refused where it begins, however long it is") {
  const std::string hole(1000, '\0');
  CHECK(contains(mesh_refusal("a.off", hole), "line 1: found '\\x00', expected OFF"));
  CHECK(contains(mesh_refusal("a.off", "OFF\n3 1 0\n0 0 " + hole), "line 3: found '\\x00', expected a coordinate"));
  CHECK(contains(mesh_refusal("a.ply", "ply\nformat" + hole), "line 2: expected text, found byte 0"));
}

}  // namespace dmpc::apps::off_test
