// Files that a pbrt scene is made of.
#include <doctest/doctest.h>

#include <string>

#include "apps/reader/budget.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/pbrt_scenes.h"
#include "tests/support/text.h"

namespace dmpc::apps::pbrt_files_test {

using core::Vec3d;
using tests::pbrt_camera;
using tests::pbrt_triangle;
using tests::TemporaryFolder;
using tests::write_text;

namespace {

const std::string ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
/// `pbrt_triangle`, and "x", packed by gzip.
const std::string packed_x("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\xab\x00\x00\x83\x16\xdc\x8c\x01\x00\x00\x00", 21);

/// The time that reading may take bounds none of what is tested here: instrumented, on a busy machine, 100,000 files take long.
std::string refusal(const TemporaryFolder& folder, const std::string& main) {
  write_text(folder / "a.pbrt", main);
  return tests::complaint_of([&] { apps::read_mesh_file(folder / "a.pbrt", {}, false, {.seconds = 1'000}); });
}

}  // namespace

TEST_CASE("what is included stands in its place, named from the folder of the first file, and an error says whence") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  write_text(folder / "parts/b.pbrt", "Translate 1 0 0\nInclude \"parts/c.pbrt\"\n");
  write_text(folder / "parts/c.pbrt", pbrt_triangle);
  write_text(folder / "a.pbrt", pbrt_camera + "Include \"parts/b.pbrt\"\n" + pbrt_triangle);
  const MeshFile file = read_mesh_file(folder / "a.pbrt");
  REQUIRE(file.scene.objects.size() == 2);
  CHECK(file.scene.vertices[3] == Vec3d{1, 0, 0});  // what is included moves what follows
  write_text(folder / "parts/c.pbrt", "\nTriangle");
  const std::string text = refusal(folder, pbrt_camera + "Include \"parts/b.pbrt\"\n");
  CHECK(tests::contains(text, "parts/c.pbrt:2:1: \"Triangle\" is no statement"));
  CHECK(tests::contains(text, "(included from "));
  CHECK(tests::contains(text, "parts/b.pbrt:2)"));
}

TEST_CASE("what is imported leaves no trace of its state") {
  const TemporaryFolder folder;
  write_text(folder / "b.pbrt", "Translate 1 0 0 " + pbrt_triangle);
  write_text(folder / "a.pbrt", pbrt_camera + "Import \"b.pbrt\"\n" + pbrt_triangle);
  const MeshFile file = read_mesh_file(folder / "a.pbrt");
  REQUIRE(file.scene.objects.size() == 2);
  CHECK(file.scene.vertices[0] == Vec3d{1, 0, 0});
  CHECK(file.scene.vertices[3] == Vec3d{0, 0, 0});
}

TEST_CASE("files that include each other in a circle or too deep are refused") {
  const TemporaryFolder folder;
  CHECK(tests::contains(refusal(folder, "Include \"a.pbrt\""), "within itself"));
  write_text(folder / "b.pbrt", "Include \"./a.pbrt\"");
  CHECK(tests::contains(refusal(folder, "Include \"b.pbrt\""), "within itself"));
  for (int i = 0; i < 70; ++i) {
    write_text(folder / ("d" + std::to_string(i) + ".pbrt"), "Include \"d" + std::to_string(i + 1) + ".pbrt\"");
  }
  CHECK(tests::contains(refusal(folder, "Include \"d0.pbrt\""), "more than 64 deep"));
}

TEST_CASE("files that are included again and again are refused" * doctest::test_suite("slow")) {
  const TemporaryFolder folder;
  for (int i = 0; i < 40; ++i) {
    const std::string next = "Include \"n" + std::to_string(i + 1) + ".pbrt\"\n";
    write_text(folder / ("n" + std::to_string(i) + ".pbrt"), std::string(1000, '\n') + next + next);
  }
  write_text(folder / "n40.pbrt", std::string(1000, '\n'));
  CHECK(tests::contains(refusal(folder, "Include \"n0.pbrt\""), "again and again"));
  const std::string many = tests::repeated(100'001, "Include \"e\"\n");
  write_text(folder / "e", "");
  CHECK(tests::contains(refusal(folder, many), "more than 100,000 files"));
}

TEST_CASE("files that are not there, or lie elsewhere, are errors of the line that names them") {
  const TemporaryFolder folder;
  CHECK(tests::contains(refusal(folder, "\nInclude \"b.pbrt\""), "a.pbrt:2:1: "));
  CHECK(tests::contains(refusal(folder, "\nInclude \"b.pbrt\""), "is missing"));
  CHECK(tests::contains(refusal(folder, "Include \"../../../../../etc/passwd\""), "neither beside nor below the scene"));
  CHECK(tests::contains(refusal(folder, "Shape \"plymesh\" \"string filename\" \"m.ply\""), "a.pbrt:1:1: Shape \"plymesh\": "));
  CHECK(tests::contains(refusal(folder, "Shape \"plymesh\" \"string filename\" \"m.ply\""), "is missing"));
  write_text(folder / "m.ply", ply.substr(0, ply.size() - 12));
  CHECK(tests::contains(refusal(folder, "Shape \"plymesh\" \"string filename\" \"m.ply\""), "m.ply: "));
}

TEST_CASE("a mesh of its own file has its quads") {
  const TemporaryFolder folder;
  write_text(folder / "m.ply", ply);
  write_text(folder / "a.pbrt", pbrt_camera + "Shape \"plymesh\" \"string filename\" \"m.ply\"");
  const MeshFile file = read_mesh_file(folder / "a.pbrt");
  REQUIRE(file.scene.objects.size() == 1);
  CHECK(file.scene.objects[0].vertex_count == 4);
}

TEST_CASE("what is packed by gzip is unpacked, and refused where it is damaged or swells") {
  const TemporaryFolder folder;
  write_text(folder / "x.pbrt.gz", packed_x);
  CHECK(tests::contains(refusal(folder, "Include \"x.pbrt.gz\""), "x.pbrt.gz:1:1: \"x\" is no statement"));
  write_text(folder / "x.pbrt.gz", packed_x.substr(0, 12));
  CHECK(tests::contains(refusal(folder, "Include \"x.pbrt.gz\""), "is cut short"));
  std::string damaged = packed_x;
  damaged[14] = 'z';
  write_text(folder / "x.pbrt.gz", damaged);
  CHECK(tests::contains(refusal(folder, "Include \"x.pbrt.gz\""), "is damaged"));
  CHECK(is_mesh_path("A.PBRT.gz"));
  CHECK(is_mesh_path("a.Pbrt"));
  CHECK(!is_mesh_path("a.ply.gz"));
}

}  // namespace dmpc::apps::pbrt_files_test
