// Shapes of pbrt scenes, held against what is known of them.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "apps/foreign/pbrt/loop.h"
#include "core/base/expect.h"
#include "tests/support/pbrt_scenes.h"

namespace dmpc::apps::pbrt_shapes_test {

using core::ObjectKind;
using core::Vec3d;
using tests::pbrt_refusal;
using tests::read_pbrt;

namespace {

double area_of(const core::Scene& scene) {
  double area = 0;
  for (const core::Object& object : scene.objects) {
    const auto corner = [&](std::uint32_t i) { return scene.vertices[object.first + i]; };
    for (std::uint32_t i = 2; i < object.vertex_count; ++i) {
      area += length(cross(corner(i - 1) - corner(0), corner(i) - corner(0))) / 2;
    }
  }
  return area;
}

const std::string octahedron =
    "\"point3 P\" [1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1]\n"
    "\"integer indices\" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]\n";

}  // namespace

TEST_CASE("a sphere stays one where it is moved and scaled evenly, and is a mesh where it is not, or is cut") {
  const core::Scene scene = read_pbrt("Translate 1 2 3 Rotate 30 1 1 1 Scale 2 2 -2 Shape \"sphere\" \"float radius\" 1.5").scene;
  REQUIRE(scene.spheres.size() == 1);
  CHECK(length(scene.spheres[0].center - Vec3d{1, 2, 3}) < 1e-12);
  CHECK(scene.spheres[0].radius == doctest::Approx(3));
  const core::Scene egg = read_pbrt("Scale 1 1 2 Shape \"sphere\"").scene;
  CHECK(egg.spheres.empty());
  CHECK(egg.objects.size() > 1000);
  const core::Scene blue =
      read_pbrt("Shape \"sphere\" Material \"diffuse\" \"rgb reflectance\" [0 0 1] Scale 1 1 2 Shape \"sphere\"").scene;
  CHECK(blue.materials[blue.objects.back().material].color == Vec3d{0, 0, 1});
  const core::Scene cap = read_pbrt("Shape \"sphere\" \"float zmin\" 0").scene;  // half of it: 2 pi
  CHECK(area_of(cap) == doctest::Approx(2 * std::acos(-1)).epsilon(0.01));
}

TEST_CASE("disks and cylinders have their area, and normals that point out") {
  const double pi = std::acos(-1);
  const core::Scene disk = read_pbrt("Shape \"disk\" \"float radius\" 2 \"float innerradius\" 1 \"float height\" 5").scene;
  CHECK(area_of(disk) == doctest::Approx(3 * pi).epsilon(0.01));
  CHECK(disk.vertices[0].z == 5);
  const core::Scene half =
      read_pbrt("Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 0 \"float zmax\" 3 \"float phimax\" 180").scene;
  CHECK(area_of(half) == doctest::Approx(6 * pi).epsilon(0.01));
  CHECK(half.objects[0].kind == ObjectKind::patch);
  CHECK(dot(half.normals[0], half.vertices[0]) > 0);
}

TEST_CASE("triangles that have normals look to where these point") {
  const std::string points = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] ";
  CHECK(read_pbrt(points + "\"normal N\" [0 0 1 0 0 1 0 0 1]").scene.vertices[0] == Vec3d{0, 0, 0});
  CHECK(read_pbrt(points + "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]").scene.vertices[0] == Vec3d{0, 1, 0});
  CHECK(read_pbrt(points + "\"normal N\" [0 0 1 0 1 0 1 0 0]").scene.objects[0].kind == ObjectKind::patch);
}

TEST_CASE("a bilinear patch is a quad where it is flat, and 64 where it is bent") {
  const core::Scene flat = read_pbrt("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]").scene;
  REQUIRE(flat.objects.size() == 1);
  CHECK(flat.vertices == std::vector<Vec3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const core::Scene bent = read_pbrt("Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 1]").scene;
  CHECK(bent.objects.size() == 64);
  // z = x y over the unit square.
  for (const Vec3d& vertex : bent.vertices) {
    CHECK(vertex.z == doctest::Approx(vertex.x * vertex.y));
  }
}

TEST_CASE("a bilinear patch lies on its texture as a whole where it does not say how, flat or bent") {
  const std::string checks = "Texture \"c\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"c\" ";
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 ";
  const core::Scene flat = read_pbrt(checks + patch + "0]").scene, bent = read_pbrt(checks + patch + "1]").scene;
  REQUIRE(flat.corners.size() == 4);
  REQUIRE(bent.corners.size() == 4 * 64);
  // From u = v = 0 to u = 1, and to u = v = 1; of the bent one of the last quad.
  const auto u = [](const core::TexturedCorner& corner) { return corner.place[0]; };
  CHECK(u(flat.corners[1]) - u(flat.corners[0]) == u(bent.corners[4 * 63 + 2]) - u(bent.corners[0]));
  CHECK(flat.corners[2].place == bent.corners[4 * 63 + 2].place);
  CHECK(flat.corners[0].place == bent.corners[0].place);
}

TEST_CASE("a mesh that is subdivided ends on the limit of its surface") {
  // All vertices of an octahedron have four neighbours: the limit of (1, 0, 0) is (1 - 4 g) (1, 0, 0) + g times the sum of its
  // neighbours, which is 0, with g = 1 / (4 + 3 / (8 * 3/32)) = 1/8: a half.
  const core::Scene scene = read_pbrt("Shape \"loopsubdiv\" \"integer levels\" 0 " + octahedron).scene;
  CHECK(scene.objects.size() == 8);
  CHECK(scene.vertices[0] == Vec3d{0.5, 0, 0});
  // However often it is divided before, its limit stays, and normals there point along it.
  const PolygonMesh fine = pbrt::subdivided({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                                            {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}, 3);
  CHECK(fine.faces.ends.size() == 8 * 64);
  CHECK(length(fine.vertices[0] - Vec3d{0.5, 0, 0}) < 1e-12);
  CHECK(fine.faces.corners[0] == 0);
  CHECK(length(normalize(fine.normals[0]) - Vec3d{1, 0, 0}) < 1e-12);
}

TEST_CASE("edges of what is subdivided are cubic splines") {
  // The ends of one open triangle: 3/4 of a vertex and 1/8 of both others, then 3/5 and 1/5.
  const PolygonMesh once = pbrt::subdivided({{0, 0, 0}, {5, 0, 0}, {0, 5, 0}}, {0, 1, 2}, 0);
  CHECK(length(once.vertices[0] - Vec3d{1, 1, 0}) < 1e-12);
  CHECK(normalize(once.normals[0]) == Vec3d{0, 0, 1});
}

}  // namespace dmpc::apps::pbrt_shapes_test
