// Statements of pbrt scenes: what is where, how it is seen, and what is refused.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "core/scene/placed_objects.h"
#include "tests/support/pbrt_scenes.h"
#include "tests/support/tables.h"
#include "tests/support/text.h"

namespace dmpc::apps::pbrt_statements_test {

using core::ObjectKind;
using core::Vec3d;
using tests::notes;
using tests::pbrt_camera;
using tests::pbrt_refusal;
using tests::pbrt_triangle;
using tests::read_mesh;
using tests::read_pbrt;

namespace {

/// The first vertex of what these statements put the point (1, 2, 3) to.
Vec3d put(const std::string& moves) {
  return read_pbrt(moves + " Shape \"trianglemesh\" \"point3 P\" [1 2 3 4 0 0 0 5 0]\n").scene.vertices.at(0);
}

bool is_near(const Vec3d& a, const Vec3d& b) { return core::largest_component(a - b) < 1e-12; }

}  // namespace

TEST_CASE("a triangle stands where its points say, and is seen by the camera over the film's pixels") {
  const MeshFile file = read_pbrt(pbrt_triangle);
  REQUIRE(file.scene.objects.size() == 1);
  CHECK(file.scene.objects[0].kind == ObjectKind::polygon);
  CHECK(file.scene.vertices == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  const core::View& view = file.scene.view;
  CHECK(view.width == 64);
  CHECK(view.height == 32);
  CHECK(is_near(view.from, {0, 0, 10}));
  CHECK(is_near(view.at, {0, 0, 9}));
  CHECK(is_near(view.up, {0, 1, 0}));
  // 90 degrees from edge to edge of 32 rows; ours go from the middle of the first to that of the last.
  CHECK(std::tan(view.angle_degrees * std::acos(-1) / 360) == doctest::Approx(31.0 / 32));
}

TEST_CASE("the angle is that of the shorter side of the picture that is asked for") {
  const MeshFile file = read_pbrt(pbrt_triangle, {.size = Resolution{16, 40}});
  CHECK(std::tan(file.scene.view.angle_degrees * std::acos(-1) / 360) == doctest::Approx(15.0 / 16));
}

TEST_CASE("transforms stand before what comes behind them, in double precision") {
  CHECK(put("") == Vec3d{1, 2, 3});
  CHECK(put("Translate 1 0 0 Scale 2 2 2") == Vec3d{3, 4, 6});
  CHECK(put("Scale 2 2 2 Translate 1 0 0") == Vec3d{4, 4, 6});
  CHECK(is_near(put("Rotate 90 0 0 2"), {-2, 1, 3}));
  CHECK(put("Transform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1]") == Vec3d{6, 8, 10});
  CHECK(put("Translate 1 1 1 ConcatTransform [0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1]") == Vec3d{-1, 2, 4});
  CHECK(put("Translate 1 1 1 Identity") == Vec3d{1, 2, 3});
  CHECK(put("Translate 1 0 0 CoordinateSystem \"a\" Identity CoordSysTransform \"a\"") == Vec3d{2, 2, 3});
  CHECK(put("AttributeBegin Translate 9 9 9 AttributeEnd TransformBegin Scale 9 9 9 TransformEnd") == Vec3d{1, 2, 3});
  CHECK(put("ActiveTransform EndTime Translate 9 9 9 ActiveTransform All Translate 0.1 0.2 0") == Vec3d{1.1, 2.2, 3});
}

TEST_CASE("what is said between TransformBegin and TransformEnd ends there, as with attributes") {
  const std::string red = "Material \"diffuse\" \"rgb reflectance\" [1 0 0]\n";
  for (const std::string name : {"Transform", "Attribute"}) {
    const MeshFile file =
        read_pbrt(name + "Begin " + red + "ReverseOrientation AreaLightSource \"diffuse\" ActiveTransform EndTime " + name +
                  "End Translate 1 2 3\n" + pbrt_triangle);
    REQUIRE(file.scene.objects.size() == 1);
    CHECK(tests::material_of_object(file, 0).color == Vec3d{0.5, 0.5, 0.5});
    CHECK(!tests::material_of_object(file, 0).shines());
    CHECK(file.scene.vertices[0] == Vec3d{1, 2, 3});
    CHECK(file.scene.vertices[1] == Vec3d{2, 2, 3});
  }
}

TEST_CASE("coordinates that are left-handed have x turned round, and triangles look to the side that they did") {
  const std::string left = "LookAt 0 0 10  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n";
  const MeshFile file = read_mesh("a.pbrt", left + pbrt_triangle);
  CHECK(notes(file, "left-handed"));
  CHECK(file.scene.vertices == std::vector<Vec3d>{{0, 1, 0}, {-1, 0, 0}, {0, 0, 0}});
  CHECK(is_near(file.scene.view.from, {0, 0, 10}));
  const MeshFile right = read_pbrt(pbrt_triangle);
  CHECK(!notes(right, "left-handed"));
  // Mirrored once more it looks to the other side again, and turned by ReverseOrientation, too.
  CHECK(read_pbrt("Scale 1 -1 1 " + pbrt_triangle).scene.vertices == std::vector<Vec3d>{{0, -1, 0}, {1, 0, 0}, {0, 0, 0}});
  CHECK(read_pbrt("ReverseOrientation " + pbrt_triangle).scene.vertices == std::vector<Vec3d>{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}});
}

TEST_CASE("an object stands wherever it is named, its own transform behind the instance's") {
  const MeshFile file = read_pbrt("ObjectBegin \"o\" Translate 1 0 0\n" + pbrt_triangle +
                                  "ObjectEnd\nScale 2 2 2\nObjectInstance \"o\"\nIdentity ObjectInstance \"o\"\n");
  REQUIRE(file.scene.objects.size() == 2);
  CHECK(file.scene.vertices[0] == Vec3d{2, 0, 0});
  CHECK(file.scene.vertices[3] == Vec3d{1, 0, 0});
  CHECK(notes(file, "1 mesh stands in 2 places: 1 triangles become 2"));
}

TEST_CASE("an object may be named before it begins") {
  const MeshFile file = read_pbrt("Translate 0 0 5 ObjectInstance \"o\" AttributeBegin ObjectBegin \"o\" Translate 1 0 0\n" +
                                  pbrt_triangle + "ObjectEnd AttributeEnd ObjectInstance \"o\"\n");
  REQUIRE(file.scene.objects.size() == 2);
}

TEST_CASE("what is large and stands in several places is kept as a mesh, turned round or not, beside what is round there") {
  std::string corners, indices;
  for (int i = 0; i < 65; ++i) {
    corners += std::to_string(i) + " 0 0 " + std::to_string(i) + " 1 0 ";
    indices += std::to_string(2 * i) + " " + std::to_string(2 * i + 1) + " " + std::to_string((2 * i + 2) % 130) + " ";
  }
  const std::string mesh = "Shape \"trianglemesh\" \"point3 P\" [" + corners + "] \"integer indices\" [" + indices + "]\n";
  const std::string object = "ObjectBegin \"o\" Shape \"sphere\" \"float radius\" 2\n" + mesh + "ObjectEnd\n";
  const MeshFile file = read_pbrt(object + "ObjectInstance \"o\" Translate 0 0 5 Scale -1 1 1 ObjectInstance \"o\"\n");
  REQUIRE(file.scene.kept);
  CHECK(file.scene.kept->meshes.size() == 1);
  REQUIRE(file.scene.kept->places.size() == 2);
  CHECK(file.scene.kept->places[0].first == 1);
  CHECK(file.scene.kept->places[1].first == 67);
  REQUIRE(file.scene.objects.size() == 132);
  CHECK(file.scene.objects[66].kind == core::ObjectKind::sphere);
  CHECK(file.scene.spheres[1].center == Vec3d{0, 0, 5});
  const auto corner = [&](std::uint32_t object, std::uint32_t i) {
    return file.scene.vertices[file.scene.objects[object].first + i];
  };
  CHECK(corner(2, 0) == Vec3d{1, 0, 0});
  CHECK(corner(68, 2) == Vec3d{-1, 0, 5});  // a mirror's faces are turned back
  const MeshFile left = read_pbrt(object + "ObjectInstance \"o\" Translate 0 0 5 Scale -1 1 1 ObjectInstance \"o\"\n",
                                  {.copies = core::Copies::left_out});
  CHECK(left.scene.objects.size() == 2);
  CHECK(object_count(left.scene) == 132);
  CHECK(left.scene.view.from == file.scene.view.from);
}

TEST_CASE("what is said of shapes by Attribute holds for those that do not say it, until the attributes end") {
  const MeshFile file = read_pbrt(
      "AttributeBegin Attribute \"shape\" \"float radius\" 3\nShape \"sphere\"\nShape \"sphere\" \"float radius\" 2 "
      "AttributeEnd\n"
      "Shape \"sphere\"\n");
  REQUIRE(file.scene.spheres.size() == 3);
  CHECK(file.scene.spheres[0].radius == 3);
  CHECK(file.scene.spheres[1].radius == 2);
  CHECK(file.scene.spheres[2].radius == 1);
}

TEST_CASE("of parameters that are said twice the last counts, whatever says it, and nothing is said of the first") {
  const MeshFile lamp =
      read_pbrt("AreaLightSource \"diffuse\" \"rgb L\" [1 0 0] \"bool twosided\" true \"rgb L\" [0 1 0]\n" + pbrt_triangle);
  CHECK(tests::material_of_object(lamp, 0).emission == Vec3d{0, 1, 0});
  CHECK(!notes(lamp, "\"L\""));
  const std::string texture = "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0]\n";
  const auto color = [&](const std::string& said) {
    return tests::material_of_object(read_pbrt(texture + "Material \"diffuse\" " + said + "\n" + pbrt_triangle), 0).color;
  };
  CHECK(color("\"texture reflectance\" \"t\" \"rgb reflectance\" [0 0 1]") == Vec3d{0, 0, 1});
  CHECK(color("\"rgb reflectance\" [0 0 1] \"texture reflectance\" \"t\"") == Vec3d{1, 0, 0});
  const MeshFile attributes = read_pbrt(
      "Attribute \"material\" \"rgb reflectance\" [1 0 0] \"rgb reflectance\" [0 1 0]\n"
      "Material \"diffuse\"\n" +
      pbrt_triangle);
  CHECK(tests::material_of_object(attributes, 0).color == Vec3d{0, 1, 0});
}

TEST_CASE("text may have remarks, lines that end by two bytes, a mark in front, and no end of its last line") {
  const std::string text =
      "\xef\xbb\xbf# Stra\xc3\x9f"
      "e\r\n" +
      pbrt_camera + "# a remark [ \" \r\nShape \"trianglemesh\"\r\n\"point3 P\" [0 0 0 1 0 0 0 1 0]";
  CHECK(read_mesh("a.pbrt", text).scene.objects.size() == 1);
}

TEST_CASE("an integrator's depth is that of paths, whose bounces are one fewer, and other integrators are said") {
  const auto read = [](const std::string& integrator) {
    return read_mesh("a.pbrt", integrator + " WorldBegin " + pbrt_triangle);
  };
  CHECK(read("").scene.bounces == 4);
  CHECK(read("Integrator \"path\"").scene.bounces == 4);
  CHECK(read("Integrator \"bdpt\" \"integer maxdepth\" 65").scene.bounces == 64);
  CHECK(read("Integrator \"volpath\" \"integer maxdepth\" 1").scene.bounces == 0);
  CHECK(notes(read("Integrator \"volpath\" \"integer maxdepth\" 0"), "maxdepth is 0, shown with 0 bounces"));
  CHECK(notes(read("Integrator \"path\" \"integer maxdepth\" 1000"), "maxdepth is 1000, shown with 253 bounces"));
  CHECK(notes(read("Integrator \"ambientocclusion\""), "--sky=1 --bounces=0"));
  CHECK(tests::contains(tests::mesh_refusal("a.pbrt", "Integrator \"whitted\""), "no integrator of kind 'whitted'"));
  CHECK(notes(read("Sampler \"halton\" \"integer pixelsamples\" 128"), "128 samples a pixel: --samples=128"));
  CHECK(notes(read("Sampler \"stratified\" \"integer xsamples\" 8 \"integer ysamples\" 2"), "16 samples a pixel"));
}

TEST_CASE("statements that make no scene are refused, with file, line and column") {
  const auto complaint = [](const std::string& world) { return tests::mesh_refusal("a.pbrt", pbrt_camera + world); };
  tests::check_complaints(complaint, tests::complaints_in("apps/foreign/pbrt/refusals.txt"));
  CHECK(tests::contains(pbrt_refusal(std::string("\x01", 1)), "a byte that no text has, 1"));
  CHECK(tests::contains(pbrt_refusal(std::string((1U << 20U) + 2, 'x')), "has a word of more than 1 MiB"));
  CHECK(tests::contains(pbrt_refusal('"' + std::string(1U << 20U, 'x') + "\"\n"), "or only after more than 1 MiB"));
}

TEST_CASE("scenes of pbrt-v3 are told by what tells them, and by what makes them new") {
  for (const char* const old :
       {"WorldEnd", "SurfaceIntegrator \"path\"", "Material \"matte\"", "Shape \"sphere\" \"point P\" [0 0 0]"}) {
    CHECK(tests::contains(pbrt_refusal(old), "pbrt --upgrade"));
  }
  CHECK(tests::contains(tests::mesh_refusal("a.pbrt", "Film \"image\" \"integer xresolution\" 4"),
                        "Film \"image\": is of pbrt-v3"));
}

TEST_CASE("a million brackets, attributes within each other and endless words are an error, or nothing, and soon") {
  CHECK(tests::contains(pbrt_refusal("Shape \"sphere\" \"float radius\" " + tests::repeated(1'000'000, "[")),
                        "has '[', expected a number"));
  CHECK(tests::contains(pbrt_refusal(tests::repeated(200'000, "AttributeBegin ")), "stand within each other"));
  CHECK(read_pbrt(tests::repeated(1000, "AttributeBegin ") + tests::repeated(1000, "AttributeEnd ") + pbrt_triangle)
            .scene.objects.size() == 1);
  CHECK(tests::contains(pbrt_refusal(std::string(1'000'000, 'x')), "is no statement"));
}

TEST_CASE("what is pressed flat is shown flat, and a camera in what is pressed flat is refused") {
  CHECK(read_pbrt("Scale 1 1 0 " + pbrt_triangle).scene.objects.size() == 1);
  CHECK(tests::contains(tests::mesh_refusal("a.pbrt", "Scale 1 0 1 Camera \"perspective\" WorldBegin " + pbrt_triangle),
                        "pressed flat"));
}

TEST_CASE("that what is thick is pressed so flat that floats may take its back for its front is said") {
  const std::string words = "shapes pressed so flat that floats may not tell front from back, where the wrong one may show: 2";
  const std::string tent = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1] \"integer indices\" [0 1 2 0 1 3]\n";
  CHECK(notes(read_pbrt("Scale 1 1e-6 1 Shape \"sphere\"\n" + tent), words));
  CHECK(!notes(read_pbrt("Scale 1 1e-6 1 Shape \"disk\"\n" + pbrt_triangle), "pressed"));
  CHECK(!notes(read_pbrt("Shape \"sphere\" Scale 1 1e-3 1 Shape \"sphere\" Scale 1 0 1 Shape \"sphere\"\n"), "pressed"));
  CHECK(!notes(read_pbrt("Scale 1e-6 1e-6 1e-6 Shape \"sphere\"\n" + tent), "pressed"));
}

TEST_CASE(
    "that spheres are not turned inside out is said, which matters for glass and for light, but not of those that become "
    "meshes") {
  CHECK(notes(read_pbrt("ReverseOrientation Shape \"sphere\" Shape \"sphere\" Scale 1 2 1 Shape \"sphere\"\n"),
              "spheres that are turned inside out, shown as if they were not: 2"));
  CHECK(!notes(read_pbrt("Shape \"sphere\" ReverseOrientation\n" + pbrt_triangle), "inside out"));
}

TEST_CASE("of a hundred kinds of what says nothing each is counted by itself, of all others their sum") {
  std::string shapes;
  for (int i = 0; i < 30'000; ++i) {
    shapes += "Shape \"sphere\" \"float w" + std::to_string(i) + "\" 1\n";
  }
  const MeshFile file = read_pbrt(shapes);
  CHECK(notes(file, "parameters \"w99\" that mean nothing where they stand: 1"));
  CHECK(!notes(file, "parameters \"w100\""));
  CHECK(notes(file, "what of more kinds is not shown as it is, or means nothing where it stands: 29,900"));
}

TEST_CASE("what says nothing here is counted once a kind") {
  const MeshFile file = read_pbrt(
      "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 1 1 1]\nShape \"curve\"\n"
      "Shape \"sphere\" \"float weight\" 1\nMediumInterface \"fog\" \"\"\n" +
      pbrt_triangle);
  CHECK(notes(file, "curves left out: 2"));
  CHECK(notes(file, "parameters \"weight\" that mean nothing where they stand: 1"));
  CHECK(notes(file, "media, which are not shown: 1"));
}

}  // namespace dmpc::apps::pbrt_statements_test
