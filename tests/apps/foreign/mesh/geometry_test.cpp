#include "apps/foreign/mesh/geometry.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"

namespace dmpc::apps::geometry_test {

TEST_CASE("a scene has room for as many corners as 32 bits count, and no more") {
  CHECK_NOTHROW(check_size({}));
  CHECK_NOTHROW(check_size({.triangles = 1, .faces = 1, .corners = 4'294'967'294}));
  CHECK_THROWS_WITH_AS(check_size({.triangles = 1'431'655'765, .faces = 1'431'655'765, .corners = 4'294'967'295}),
                       doctest::Contains("1,431,655,765 triangles"), core::RoomError);
}

TEST_CASE("sizes add up") {
  GeometrySize size{1, 1, 3};
  size += {2, 1, 4};
  CHECK(size.triangles == 3);
  CHECK(size.faces == 2);
  CHECK(size.corners == 7);
}

TEST_CASE("a mesh is called by its number, and its name if it has one") {
  aiMesh mesh;
  CHECK(name_of(mesh, 3) == "mesh 3");
  mesh.mName = "wheel";
  CHECK(name_of(mesh, 3) == "mesh 3 'wheel'");
}

}  // namespace dmpc::apps::geometry_test
