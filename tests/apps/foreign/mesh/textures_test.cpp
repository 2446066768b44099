#include "apps/foreign/mesh/textures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/formats/mesh_file.h"
#include "apps/picture/image_file.h"
#include "core/scene/scene.h"
#include "tests/support/read_mesh.h"

namespace dmpc::tests::textures_test {

namespace {

using apps::MeshFile;
using apps::read_mesh_file;
using core::Material;
using core::ObjectKind;

MeshFile model(const std::string& name) { return read_mesh_file(std::string(DMPC_MODELS) + "/" + name); }

std::size_t textured_count(const core::Scene& scene) {
  return static_cast<std::size_t>(std::count_if(scene.objects.begin(), scene.objects.end(),
                                                [](const core::Object& object) { return object.kind == ObjectKind::textured; }));
}

/// A square with a texture, given by OBJ and MTL with blanks in the texture's name.
const std::string square_obj =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 2 1\nvt 0 1\nusemtl painted\nf 1/1 2/2 3/3 4/4\n"
    "usemtl plain\nf 1/1 2/2 3/3\nusemtl painted\nf 1 3 4\n";

void write_square(const TemporaryFolder& folder, const std::string& map) {
  write_text(folder / "a.obj", square_obj);
  write_text(folder / "a.mtl", "newmtl painted\nKd 0.5 1 1\n" + map + "\nnewmtl plain\nKd 0 1 0\n");
}

void write_picture(const std::filesystem::path& path) {
  apps::Image image(4, 2);
  image.rgb[0] = 1;  // the first texel, at the top left, is red
  apps::write_image(path, image);
}

}  // namespace

TEST_CASE("a face with a texture has its corners' places, t downwards from the picture's top") {
  const TemporaryFolder folder;
  write_square(folder, "map_Kd my wood.png");
  write_picture(folder / "my wood.png");
  const core::Scene scene = read_mesh_file(folder / "a.obj").scene;
  REQUIRE(scene.textures.size() == 1);
  CHECK(scene.textures[0].levels[0].width == 4);
  CHECK(scene.textures[0].levels[0].texels[0] == 0x0000ff);
  REQUIRE(textured_count(scene) == 1);
  const auto object = std::find_if(scene.objects.begin(), scene.objects.end(),
                                   [](const core::Object& each) { return each.kind == ObjectKind::textured; });
  const Material& material = scene.materials[object->material];
  CHECK(material.texture == 0);
  CHECK(material.color.x == doctest::Approx(0.5));  // multiplies the texture
  for (std::uint32_t corner = 0; corner < object->vertex_count; ++corner) {
    const core::Vec3d& vertex = scene.vertices[object->first + corner];
    const auto& place = scene.corners[object->first_normal + corner].place;
    CHECK(place[0] == 2 * vertex.x);
    CHECK(place[1] == 1 - vertex.y);
  }
}

TEST_CASE("faces without a textured material or without places are plain") {
  const TemporaryFolder folder;
  write_square(folder, "map_Kd wood.png");
  write_picture(folder / "wood.png");
  const core::Scene scene = read_mesh_file(folder / "a.obj").scene;
  for (const core::Object& object : scene.objects) {
    CHECK((object.kind == ObjectKind::textured) == (scene.materials[object.material].texture != Material::no_texture));
  }
  CHECK(scene.objects.size() == textured_count(scene) + 2);
}

TEST_CASE("all textures that are missing are named in one error") {
  const TemporaryFolder folder;
  write_square(folder, "map_Kd gone.png");
  CHECK_THROWS_WITH_AS(read_mesh_file(folder / "a.obj"), doctest::Contains("gone.png"), core::InputError);
  CHECK_THROWS_WITH_AS(read_mesh_file(folder / "a.obj"), doctest::Contains("--missing=plain"), core::InputError);
}

TEST_CASE("a texture that may be missing is named, once, and the rest is shown in its plain colour") {
  const TemporaryFolder folder;
  write_square(folder, "map_Kd gone.png");
  const MeshFile file = read_mesh_file(folder / "a.obj", {.allows_missing = true});
  CHECK(textured_count(file.scene) == 0);
  CHECK(std::count_if(file.notes.begin(), file.notes.end(),
                      [](const std::string& note) { return note.find("gone.png") != std::string::npos; }) == 1);
  CHECK(notes(file, "; what it covers has its plain colour"));
}

TEST_CASE("textures beside a glTF file, within one as text, and within a .glb are the same") {
  const core::Scene beside = model("glTF2/BoxTextured-glTF/BoxTextured.gltf").scene;
  REQUIRE(beside.textures.size() == 1);
  CHECK(textured_count(beside) == 12);
  for (const std::string name :
       {"glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb"}) {
    CAPTURE(name);
    const core::Scene within = model(name).scene;
    REQUIRE(within.textures.size() == 1);
    CHECK(within.textures[0].levels[0].texels == beside.textures[0].levels[0].texels);
    CHECK(textured_count(within) == 12);
  }
}

TEST_CASE("a texture that several materials have is read once") {
  const core::Scene scene = model("OBJ/spider.obj").scene;
  CHECK(scene.textures.size() == 4);
  CHECK(textured_count(scene) > 1000);
}

}  // namespace dmpc::tests::textures_test
