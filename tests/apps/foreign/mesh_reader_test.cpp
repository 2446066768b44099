#include "apps/formats/mesh_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "apps/scene/scene_setup.h"
#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/read_mesh.h"

namespace dmpc::apps::mesh_reader_test {

using core::ObjectKind;
using core::Scene;
using core::Vec3d;
using tests::contains;
using tests::Gltf;
using tests::mesh_refusal;
using tests::notes;

namespace {

MeshFile read(const std::string& name, const std::string& text, const MeshOptions& options = {}) {
  return tests::read_mesh(name, text, options);
}

MeshFile read(const Gltf& gltf, const MeshOptions& options = {}) { return read("a.gltf", gltf.text(), options); }

const std::vector<Vec3d> triangle = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};

}  // namespace

TEST_CASE("a triangle is the same in every format") {
  for (const MeshFile& file :
       {read("a.obj", tests::triangle_obj), read("a.ply", tests::triangle_ply), read("a.stl", tests::triangle_stl),
        read("a.STL", tests::triangle_binary_stl()), read("a.gltf", Gltf{}.text()), read("a.glb", Gltf{}.binary())}) {
    CAPTURE(file.scene.name);
    REQUIRE(file.scene.objects.size() == 1);
    CHECK(file.scene.objects[0].kind == ObjectKind::polygon);
    CHECK(file.scene.vertices == triangle);
    CHECK(notes(file, "the whole is in view"));
    CHECK(file.notes.size() <= 2);  // and who read it
    CHECK(notes(file, "the whole is in view, as by --camera="));
  }
}

TEST_CASE("what says nothing of its colour is grey in every format, but for glTF, which says that it is white") {
  const Vec3d grey{0.6, 0.6, 0.6};
  for (const MeshFile& file :
       {read("a.obj", tests::triangle_obj), read("a.ply", tests::triangle_ply), read("a.stl", tests::triangle_stl),
        read("b.stl", tests::triangle_binary_stl()), read("a.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n")}) {
    CAPTURE(file.scene.name);
    const Vec3d color = file.scene.materials[file.scene.objects.at(0).material].color;
    CHECK(length(color - grey) < 1e-6);
  }
  const Scene gltf = read(Gltf{}).scene;
  CHECK(gltf.materials[gltf.objects.at(0).material].color == Vec3d{1, 1, 1});
}

TEST_CASE("a colour that a PLY or STL file says is kept, be it white") {
  const std::string material =
      "element material 1\nproperty uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar diffuse_blue\nend_header\n";
  std::string ply = tests::triangle_ply + "255 255 255\n";
  ply.replace(ply.find("end_header\n"), 11, material);
  std::string stl = tests::triangle_binary_stl();
  stl.replace(0, 10, "COLOR=\xff\xff\xff\xff");
  for (const Scene& scene : {read("a.ply", ply).scene, read("a.stl", stl).scene}) {
    CAPTURE(scene.name);
    CHECK(scene.materials[scene.objects.at(0).material].color == Vec3d{1, 1, 1});
  }
}

TEST_CASE("a path is a mesh file's by its ending, in small letters or large") {
  CHECK(is_mesh_path("a/b.obj"));
  CHECK(is_mesh_path("A.GLB"));
  CHECK_FALSE(is_mesh_path("a.nff"));
  CHECK_FALSE(is_mesh_path("obj"));
  CHECK_FALSE(is_mesh_path("a.obj/b"));
  CHECK_FALSE(is_mesh_path(""));
  CHECK(contains(known_mesh_formats(), "obj, ply, stl, off, gltf, glb"));
}

TEST_CASE("a face keeps all its corners, points and lines are left out and counted") {
  const MeshFile file = read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\np 3\n");
  CHECK(file.scene.objects.size() == 1);
  CHECK(file.scene.objects[0].vertex_count == 4);
  CHECK(notes(file, "points and lines left out: 2"));
}

TEST_CASE("transforms of nested nodes act from the leaf to the root") {
  Gltf gltf;
  gltf.nodes = R"([{"translation":[10,0,0],"children":[1]},{"scale":[2,3,4],"children":[2]},)"
               R"({"rotation":[0,0,1,0],"mesh":0}])";  // half a turn about z
  const Scene scene = read(gltf).scene;
  CHECK(scene.vertices[0] == Vec3d{10, 0, 0});
  CHECK(length(scene.vertices[1] - Vec3d{6, 0, 0}) < 1e-6);
  CHECK(length(scene.vertices[2] - Vec3d{10, -3, 0}) < 1e-6);
}

TEST_CASE("vertex normals that differ make a patch, equal ones a flat face") {
  Gltf gltf{.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1}};
  CHECK(read(gltf).scene.objects[0].kind == ObjectKind::polygon);
  gltf.normals = {0, 0, 1, 0, 1, 0, 0, 0, 1};
  const Scene scene = read(gltf).scene;
  CHECK(scene.objects[0].kind == ObjectKind::patch);
  CHECK(scene.normals == std::vector<Vec3d>{{0, 0, 1}, {0, 1, 0}, {0, 0, 1}});
}

TEST_CASE("normals are turned by the inverse transpose") {
  Gltf gltf{.nodes = R"([{"mesh":0,"scale":[2,1,1]}])"};
  const float half = std::sqrt(0.5F);
  gltf.normals = {half, half, 0, 0, 0, 1, 0, 0, 1};
  const Vec3d normal = normalize(read(gltf).scene.normals[0]);
  CHECK(length(normal - normalize(Vec3d{0.5, 1, 0})) < 1e-6);
}

TEST_CASE("a mirrored face looks to the mirrored side, by its corners and by its normals") {
  Gltf gltf{.nodes = R"([{"mesh":0,"scale":[1,1,-1]}])"};
  gltf.normals = {0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 1};
  const Scene scene = read(gltf).scene;
  const auto& corners = scene.vertices;
  CHECK(cross(corners[1] - corners[0], corners[2] - corners[0]).z < 0);
  CHECK(scene.normals[0].z < 0);
  CHECK(length(normalize(scene.normals[1]) - Vec3d{0, 0.6, -0.8}) < 1e-6);
}

TEST_CASE("instances are expanded, and what that costs is said") {
  const MeshFile file = read({.nodes = R"([{"mesh":0},{"mesh":0,"translation":[0,0,1]},{"mesh":0}])", .roots = "[0,1,2]"});
  CHECK(file.scene.objects.size() == 3);
  CHECK(file.scene.vertices[3] == Vec3d{0, 0, 1});
  CHECK(notes(file, "1 mesh stands in 3 places: 1 triangles become 3"));
}

TEST_CASE("the scale multiplies vertices, cameras and lights") {
  Gltf gltf{.nodes = R"([{"mesh":0},{"camera":0,"translation":[0,0,5]},)"
                     R"({"extensions":{"KHR_lights_punctual":{"light":0}},"translation":[0,0,7]}])",
            .roots = "[0,1,2]"};
  gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1,"aspectRatio":1}}],)"
              R"("extensionsUsed":["KHR_lights_punctual"],)"
              R"("extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[1,1,1],"intensity":1}]}})";
  const Scene scene = read(gltf, {.scale = 10}).scene;
  CHECK(scene.vertices[1] == Vec3d{20, 0, 0});
  CHECK(scene.view.from == Vec3d{0, 0, 50});
  CHECK(scene.lights.at(0).position == Vec3d{0, 0, 70});
}

TEST_CASE("without a camera the whole scene is in view, with the axis up that was asked for") {
  for (const std::size_t up : {0U, 1U, 2U}) {
    const Scene scene = read("a.obj", tests::triangle_obj, {.up = UpAxis{up}}).scene;
    CHECK(scene.view.up[up] == 1);
    CHECK(scene.view.from[up] > scene.view.at[up]);
    for (const Vec3d& vertex : scene.vertices) {
      const double cosine = dot(normalize(vertex - scene.view.from), normalize(scene.view.at - scene.view.from));
      CHECK(cosine >= std::cos(22.5 * 3.14159265358979 / 180));
    }
  }
}

TEST_CASE("the camera that is said for the whole gives the same view again, to the last bit, wherever that is") {
  for (const std::string text : {"v 10 20 30\nv 14 20 30\nv 12 23 30\nf 1 2 3\n",
                                 "v 5000001 4000020 30\nv 5000014 4000020 30\nv 5000012 4000023 31\nf 1 2 3\n"}) {
    const MeshFile file = read("a.obj", text, {.up = UpAxis{2}});
    const CameraChoice camera = parse_camera(file.notes.back().substr(file.notes.back().find('=') + 1));
    CHECK(camera.from == file.scene.view.from);
    CHECK(camera.at == file.scene.view.at);
    CHECK(camera.up == file.scene.view.up);
  }
}

TEST_CASE("--smooth replaces the file's normals") {
  const std::string roof = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 1 3 4\n";
  CHECK(read("a.obj", roof).scene.objects[0].kind == ObjectKind::polygon);
  CHECK(read("a.obj", roof, {.smooth_degrees = 60}).scene.objects[0].kind == ObjectKind::polygon);
  CHECK(read("a.obj", roof, {.smooth_degrees = 120}).scene.objects[0].kind == ObjectKind::patch);
  const Gltf bent{.normals = {0, 0, 1, 0, 1, 0, 0, 0, 1}};
  CHECK(read(bent, {.smooth_degrees = 60}).scene.objects[0].kind == ObjectKind::polygon);
}

TEST_CASE("without lights there is a key light and a fill in the eye") {
  const Scene scene = read("a.obj", tests::triangle_obj).scene;
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.lights[0].color.x > scene.lights[1].color.x);
  CHECK(scene.lights[1].position == scene.view.from);
  CHECK_FALSE(scene.background == Vec3d{});
}

TEST_CASE("what cannot be read is refused, by the file's name") {
  const tests::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_mesh_file(folder / "none.obj"), doctest::Contains("none.obj: cannot be opened: No such file"),
                       core::InputError);
  CHECK_THROWS_WITH_AS(read_mesh_file(folder.path()), doctest::Contains("is a folder"), core::InputError);
  CHECK(contains(mesh_refusal("a.obj", ""), "a.obj: "));
  CHECK(contains(mesh_refusal("a.gltf", "{\"asset\""), "a.gltf: "));
  CHECK(contains(mesh_refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n"),
                 "line 4: the face has vertex 7, which does not exist"));
}

TEST_CASE("a missing buffer is named") { CHECK(contains(mesh_refusal("a.gltf", Gltf{}.json("wheels.bin")), "wheels.bin")); }

TEST_CASE("a missing material library is an error, or said, once, and the mesh shown without it") {
  const std::string text = "mtllib paint.mtl\nmtllib paint.mtl\nusemtl red\n" + tests::triangle_obj;
  CHECK(tests::count(mesh_refusal("a.obj", text), "paint.mtl is missing") == 1);
  const MeshFile file = read("a.obj", text, {.allows_missing = true});
  CHECK(file.scene.objects.size() == 1);
  CHECK(notes(file, "paint.mtl is missing"));
}

TEST_CASE("a file without triangles is refused") {
  CHECK(contains(mesh_refusal("a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "no triangle"));
  CHECK(contains(mesh_refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n"), "no triangle"));
}

TEST_CASE("a coordinate that is not finite is refused, with its mesh and vertex") {
  Gltf gltf;
  gltf.corners[3] = std::nanf("");
  CHECK(contains(mesh_refusal("a.gltf", gltf.text()), "wheel"));
  CHECK(contains(mesh_refusal("a.gltf", gltf.text()), "vertex 1 has a coordinate that is not a number"));
  gltf.corners[3] = std::numeric_limits<float>::infinity();
  CHECK(contains(mesh_refusal("a.gltf", gltf.text()), "vertex 1"));
  gltf.corners[3] = 1e31F;
  CHECK(contains(mesh_refusal("a.gltf", gltf.text()), "beyond 1e30"));
}

TEST_CASE("a transform that is not finite is refused, with its node") {
  const Gltf gltf{.nodes = R"([{"mesh":0,"name":"press","scale":[1e200,1e200,1]}])"};
  CHECK(contains(mesh_refusal("a.gltf", gltf.text()), "'press' is not finite"));
}

TEST_CASE("a node of scale 0 hides what stands at it and below, and nothing else") {
  const Gltf gltf{.nodes = R"([{"mesh":0,"scale":[0,0,0],"children":[1]},{"mesh":0},{"mesh":0,"scale":[0,0,1]},)"
                           R"({"mesh":0,"translation":[0,0,3]}])",
                  .roots = "[0,2,3]"};
  const MeshFile file = read(gltf);
  REQUIRE(file.scene.objects.size() == 1);
  CHECK(file.scene.vertices.size() == 3);
  CHECK(file.scene.vertices[0] == Vec3d{0, 0, 3});
  CHECK(contains(mesh_refusal("a.gltf", Gltf{.nodes = R"([{"mesh":0,"scale":[0,0,0]}])"}.text()), "no triangle"));
}

TEST_CASE("what is pressed flat shows its plane, with the plane's own normals") {
  Gltf gltf{.nodes = R"([{"mesh":0,"scale":[1,1,0]}])"};
  gltf.corners = {0, 0, 5, 2, 0, 7, 0, 1, 9};
  gltf.normals = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const MeshFile file = read(gltf);
  REQUIRE(file.scene.objects.size() == 1);
  CHECK(file.scene.vertices[1] == Vec3d{2, 0, 0});
  CHECK(file.scene.normals.empty());
}

}  // namespace dmpc::apps::mesh_reader_test
