#include "apps/lab/bench/stability/bodies.h"

#include <doctest/doctest.h>

#include "apps/lab/bench/stability/mesh.h"

namespace dmpc::tests::bodies_test {

using namespace dmpc::apps;

TEST_CASE("every mesh among the closed bodies is closed") {
  for (const ClosedBody& body : closed_bodies()) {
    CAPTURE(body.name);
    CHECK((!body.is_mesh || is_closed(core::build_database(body.scene, {}).primitives())));
  }
  const core::Database fine = core::build_database(fine_sphere().scene, {});
  CHECK(fine.primitives().size() == 9660);
  CHECK(is_closed(fine.primitives()));
}

TEST_CASE("a mesh with a triangle missing, turned over or moved is not closed") {
  Mesh mesh = tetrahedron();
  CHECK(is_closed(core::build_database(scene_of(mesh), {}).primitives()));
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  CHECK_FALSE(is_closed(core::build_database(scene_of(mesh), {}).primitives()));
  mesh.triangles.erase(mesh.triangles.begin());
  CHECK_FALSE(is_closed(core::build_database(scene_of(mesh), {}).primitives()));
  CHECK(is_closed({}));
}

TEST_CASE("a scene is scaled first, then moved, then rounded") {
  core::Scene scene;
  core::SceneBuilder builder(scene);
  builder.polygon({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  builder.sphere({1, 2, 3}, 4);
  const core::Scene moved = transformed(scene, 2, {10, 0, 0x1p-30}, true);
  CHECK(moved.vertices[0] == core::Vec3d{12, 0, 0x1p-30});
  CHECK(moved.vertices[2] == core::Vec3d{10, 0, 2});
  CHECK(moved.spheres[0].center == core::Vec3d{12, 4, 6});
  CHECK(moved.spheres[0].radius == 8);
}

}  // namespace dmpc::tests::bodies_test
