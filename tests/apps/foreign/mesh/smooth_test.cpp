#include "apps/foreign/mesh/smooth.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dmpc::apps::smooth_test {

using core::Vec3d;

namespace {

/// Two unit triangles that share the edge from (0 0 0) to (0 1 0), at a right angle; each has vertices of its own.
const std::vector<Vec3d> roof = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, -1}};
const FaceList two_faces = {{0, 1, 2, 3, 4, 5}, {3, 6}};

bool along(const Vec3d& a, const Vec3d& b) { return length(normalize(a) - normalize(b)) < 1e-12; }

}  // namespace

TEST_CASE("faces within the angle share their normals where they meet, and nowhere else") {
  const std::vector<Vec3d> normals = smooth_normals(roof, two_faces, 91);
  const Vec3d first{0, 0, 1}, second{-1, 0, 0}, both{-1, 0, 1};
  REQUIRE(normals.size() == 6);
  CHECK(along(normals[0], both));
  CHECK(along(normals[1], first));
  CHECK(along(normals[2], both));
  CHECK(along(normals[3], both));
  CHECK(along(normals[4], both));
  CHECK(along(normals[5], second));
}

TEST_CASE("faces beyond the angle keep their edge") {
  const std::vector<Vec3d> normals = smooth_normals(roof, two_faces, 89);
  CHECK(along(normals[0], {0, 0, 1}));
  CHECK(along(normals[3], {-1, 0, 0}));
}

TEST_CASE("large faces count more than small ones") {
  std::vector<Vec3d> vertices = roof;
  vertices[5].z = -3;
  CHECK(along(smooth_normals(vertices, two_faces, 180)[0], {-3, 0, 1}));
}

TEST_CASE("where every face counts, normals are those of a little less") {
  CHECK(smooth_normals(roof, two_faces, 180) == smooth_normals(roof, two_faces, 179));
}

TEST_CASE("many faces around one vertex are smooth in time of their number") {
  constexpr std::uint32_t count = 200'000;
  std::vector<Vec3d> vertices{{0, 0, 1}};
  FaceList fan;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 6.28 * i / count;
    vertices.push_back({std::cos(angle), std::sin(angle), 0});
    fan.corners.insert(fan.corners.end(), {0, i + 1, i + 1 < count ? i + 2 : 1});
    fan.ends.push_back(3 * (i + 1));
  }
  CHECK(along(smooth_normals(vertices, fan, 180)[0], smooth_normals(vertices, fan, 180)[3]));
}

TEST_CASE("a face without area has no normals and gives none") {
  std::vector<Vec3d> vertices = roof;
  vertices[5] = {0, 0.5, 0};
  const std::vector<Vec3d> normals = smooth_normals(vertices, two_faces, 180);
  CHECK(normals[5] == Vec3d{});
  CHECK(along(normals[0], {0, 0, 1}));
}

TEST_CASE("faces of different groups keep their edge, and those of group 0 have no normals and give none") {
  for (const double degrees : {91.0, 180.0}) {
    const std::vector<Vec3d> apart = smooth_normals(roof, two_faces, degrees, std::array{2U, 1U});
    CHECK(along(apart[0], {0, 0, 1}));
    CHECK(along(apart[3], {-1, 0, 0}));
    const std::vector<Vec3d> one = smooth_normals(roof, two_faces, degrees, std::array{0U, 1U});
    CHECK(one[0] == Vec3d{});
    CHECK(along(one[3], {-1, 0, 0}));
  }
}

TEST_CASE("nothing has no normals") { CHECK(smooth_normals({}, {}, 60).empty()); }

}  // namespace dmpc::apps::smooth_test
