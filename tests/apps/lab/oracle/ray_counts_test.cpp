// How many rays a render shoots, against an independent counter: double precision, its own intersections and its own accelerator,
// run over the SPD's own files. Rays are counted when shot, hit or miss. The counter takes hits from t = 1e-6 on and ends shadow
// rays 1e-6 before the light, so secondary counts may differ by about a thousandth; eye hits by the few rays that pass a
// silhouette within rounding. Seconds each when optimised, far longer otherwise, so not built then; check/inspection_test.cpp has
// small renders of the same families.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

#include "apps/lab/check/inspection.h"
#include "core/families/scenes.h"

namespace dmpc::tests::ray_counts_test {
namespace {

using core::Convention;

struct Expected {
  const char* scene;
  Convention convention;  ///< haines: 513x513 pixels, paper: 512x512
  std::uint64_t eye_hits, all_rays, tolerance;
};

/// A thousandth of the total.
constexpr Expected about(const char* scene, Convention convention, std::uint64_t eye_hits, std::uint64_t all_rays) {
  return {scene, convention, eye_hits, all_rays, all_rays / 1000};
}

std::uint64_t apart(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; }

std::uint64_t sum(const std::array<std::uint64_t, core::ray_kind_count>& rays) {
  return rays[0] + rays[1] + rays[2] + rays[3] + rays[4];
}

apps::Inspection inspect_all(const std::string& name, Convention convention) {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name(name));
  const core::Database database = core::build_database(scene, {});
  const int side = convention == Convention::haines ? 513 : 512;
  const core::RenderSettings settings{database.header(),
                                      core::Camera(scene.view, database.header().frame, side, side, 1),
                                      {.convention = convention, .depth_max = 5}};
  const apps::EmbreeScene embree(database.primitives(), apps::EmbreeMode::robust);
  return apps::inspect(database, embree, settings, {});
}

/// Counts, and that no ray of the whole render is unexplained. An eye hit more or less than the counter's by more than 2 would
/// have to be proved a silhouette; none is.
void check_counts(const Expected& expected) {
  CAPTURE(std::string(expected.scene));
  const apps::Inspection inspection = inspect_all(expected.scene, expected.convention);
  CHECK(apart(inspection.operations.primary_hits, expected.eye_hits) <= 2);
  CHECK(apart(sum(inspection.operations.rays), expected.all_rays) <= expected.tolerance);
  for (const apps::SettledRay& difference : inspection.differences) {
    CAPTURE(difference.traced.ray.pixel);
    CHECK(explained(difference.ruling.verdict));
  }
}

TEST_CASE("tetra shoots the rays of the independent counter, and of the 1994 paper within 9") {
  check_counts(about("tetra-6", Convention::haines, 49950, 309430));
  check_counts(about("tetra-6", Convention::paper, 49802, 311946));
  check_counts({"tetra-9", Convention::paper, 41093, 303237, 5});
  check_counts({"tetra-10", Convention::paper, 38809, 300953, 10});
}

TEST_CASE("teapot shoots the rays of the independent counter") {
  check_counts(about("teapot-12", Convention::haines, 161546, 898490));
  check_counts(about("teapot-8", Convention::haines, 161492, 899353));
  check_counts(about("teapot-12", Convention::paper, 160919, 944056));
}

TEST_CASE("mount shoots the rays of the independent counter") {
  check_counts(about("mount-6", Convention::haines, 173686, 1389970));
  check_counts(about("mount-6-t6", Convention::haines, 173524, 1371229));
  check_counts(about("mount-6-t6", Convention::paper, 172848, 1599870));
}

TEST_CASE("rings with true spheres and cylinders shoots the rays of the independent counter") {
  check_counts(about("rings-7", Convention::haines, 263169, 1664002));
  check_counts(about("rings-4", Convention::paper, 262144, 1652617));
}

TEST_CASE("rings tessellated shoots the rays of the independent counter") {
  check_counts(about("rings-4-t1", Convention::haines, 263169, 1624216));
  check_counts(about("rings-4-t1", Convention::paper, 262144, 1879826));
}

TEST_CASE("balls shoots the rays of the independent counter") {
  check_counts(about("balls-4", Convention::haines, 263169, 1394061));
  check_counts(about("balls-4", Convention::paper, 262144, 1601377));
}

TEST_CASE("tree shoots the rays of the independent counter") {
  check_counts(about("tree-11", Convention::haines, 169909, 1361004));
  check_counts(about("tree-11", Convention::paper, 169231, 1446761));
}

// No table has these; every ray must be explained all the same.
TEST_CASE("every ray of the remaining families at full size is explained") {
  for (const char* name : {"gears-4", "jacks-3", "lattice-12", "shells", "sombrero"}) {
    CAPTURE(std::string(name));
    for (const apps::SettledRay& difference : inspect_all(name, Convention::haines).differences) {
      CAPTURE(difference.traced.ray.pixel);
      CHECK(explained(difference.ruling.verdict));
    }
  }
}

}  // namespace
}  // namespace dmpc::tests::ray_counts_test

#endif
