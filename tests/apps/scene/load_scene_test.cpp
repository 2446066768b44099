#include "apps/scene/load_scene.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "tests/support/complaint.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::load_scene_test {

namespace {

std::string scene_complaint(const std::string& scene) {
  return tests::complaint_of([&] { load_scene(scene); });
}

}  // namespace

TEST_CASE("a built-in name is made, a path is read") {
  CHECK(load_scene("tetra-1").name == "tetra-1");
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "tetra-1.nff", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\ns 0 0 0 1\n");
  CHECK(load_scene((folder / "tetra-1.nff").string()).spheres.size() == 1);
}

TEST_CASE("what is neither is refused: a bare word as a name, anything else as a file") {
  CHECK(scene_complaint("nonsense").find("teapot") != std::string::npos);
  CHECK(scene_complaint("nonsense.nff").find("nonsense.nff") == 0);
  CHECK(scene_complaint("./nonsense").find("./nonsense") == 0);
  CHECK(scene_complaint(".").find("folder") != std::string::npos);
  CHECK_FALSE(scene_complaint("").empty());
}

TEST_CASE("a landscape has sizes, of which a name has to say one that there is") {
  CHECK(tests::contains(scene_complaint("grove-11"), "N from 1 to 10"));
  CHECK(tests::contains(scene_complaint("landscape-99"), "landscape-99"));
}

TEST_CASE("an unknown ending is refused with those that are known, no ending is NFF's") {
  const tests::TemporaryFolder folder;
  const std::string text = "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\ns 0 0 0 1\n";
  for (const char* name : {"plain", "a.nff", "a.NFF", "a.xyz"}) {
    tests::write_text(folder / name, text);
  }
  CHECK(load_scene((folder / "plain").string()).spheres.size() == 1);
  CHECK(load_scene((folder / "a.NFF").string()).spheres.size() == 1);
  CHECK(tests::contains(scene_complaint(folder / "a.xyz"), "expected .nff or one of obj, ply, stl"));
  CHECK(
      tests::contains(scene_complaint("a.obj.gz"), "files that end in .gz are not read: unpack a.obj.gz first, and render what"));
  CHECK(
      tests::contains(scene_complaint("a.wrl"), "files that end in .wrl are not read: convert a.wrl to glTF, OBJ, PLY, STL or"));
}

TEST_CASE("a mesh file is a scene, seen and lit as the options say") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj", tests::triangle_obj);
  PictureOptions picture{.scene = folder / "a.obj"};
  picture.scene_setup = {.camera = parse_camera("0,0,9/0,0,0"), .lights = {parse_light("1,2,3")}, .mesh = {.scale = 2}};
  const core::Scene scene = load_scene(picture, LoadNotes::silent);
  CHECK(scene.vertices[1] == core::Vec3d{4, 0, 0});
  CHECK(scene.view.from == core::Vec3d{0, 0, 9});
  CHECK(scene.lights.size() == 1);
}

TEST_CASE("a mesh that is looked at by a camera of one's own is upright, whatever camera its file has") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj", tests::triangle_obj);
  PictureOptions picture{.scene = folder / "a.obj"};
  picture.scene_setup = {.camera = parse_camera("9,0,0/0,0,0"), .mesh = {.up = UpAxis{2}}};
  CHECK(load_scene(picture, LoadNotes::silent).view.up == core::Vec3d{0, 0, 1});
  PictureOptions built_in{.scene = "tetra-1"};
  const core::Vec3d up = load_scene(built_in).view.up;
  built_in.scene_setup.camera = parse_camera("9,0,0/0,0,0");
  CHECK(load_scene(built_in).view.up == up);
}

TEST_CASE("the options of mesh files go with no other scene") {
  const std::vector<MeshOptions> all = {{.scale = 1}, {.up = UpAxis{1}}, {.smooth_degrees = 60}, {.allows_missing = true}};
  for (const MeshOptions& mesh : all) {
    PictureOptions picture{.scene = "tetra-1"};
    picture.scene_setup.mesh = mesh;
    CHECK_THROWS_WITH_AS(load_scene(picture), doctest::Contains("go with mesh files"), core::UsageError);
  }
}

TEST_CASE("a camera and lights go with built-in scenes, too") {
  PictureOptions picture{.scene = "tetra-1"};
  picture.scene_setup = {.camera = parse_camera("0,0,9/0,0,0"), .lights = {parse_light("1,2,3")}};
  CHECK(load_scene(picture).view.from == core::Vec3d{0, 0, 9});
  CHECK(load_scene(picture).lights.size() == 1);
}

TEST_CASE("a scene's own resolution is bounded, unless another is asked for") {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "huge.nff";
  tests::write_text(path, "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 65535 65535\ns 0 0 0 1\n");
  CHECK_THROWS_WITH_AS(load_scene(PictureOptions{.scene = path}),
                       doctest::Contains("huge.nff:7: found the resolution 65535 65535"), core::InputError);
  CHECK(load_scene(PictureOptions{.scene = path, .resolution = Resolution{8, 8}}).view.width == 65535);
}

TEST_CASE("whoever loads a scene learns which files were opened for it") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl p\nf 1/1 2/1 3/1\n");
  tests::write_text(folder / "a.mtl", "newmtl p\nmap_Kd link.png\n");
  write_image(folder / "real.png", Image(2, 2));
  std::filesystem::create_symlink("real.png", folder / "link.png");
  OpenedFiles opened;
  load_scene(PictureOptions{.scene = (folder / "a.obj").string()}, LoadNotes::silent, &opened);
  const std::filesystem::path resolved = std::filesystem::canonical(folder.path());
  CHECK(opened.paths() == std::set{resolved / "a.obj", resolved / "a.mtl", resolved / "real.png"});
  tests::write_text(folder / "a.nff", "v from 0 0 5 at 0 0 0 up 0 1 0 angle 45 hither 1 resolution 8 8\n");
  OpenedFiles single;
  load_scene(PictureOptions{.scene = (folder / "a.nff").string()}, LoadNotes::silent, &single);
  CHECK(single.paths() == std::set{resolved / "a.nff"});
}

}  // namespace dmpc::apps::load_scene_test
