#include "apps/bench/speed/recording.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <vector>

#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/picture/render.h"

namespace dmpc::tests {

using apps::RayClass;
using apps::RaySample;
using apps::Recording;

namespace {

constexpr std::size_t plenty = 1'000'000;

apps::Subject recorded_subject(const std::string& scene = "balls-1") {
  apps::PictureOptions picture;
  picture.scene = scene;
  picture.resolution = {24, 16};
  return build_subject(load_scene(picture), picture);
}

bool same_bits(const std::vector<core::Ray>& a, const std::vector<core::Ray>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(core::Ray)) == 0;
}

/// Rays whose pixels are 0, 1, 2, ...
std::vector<std::uint32_t> kept_of(std::uint32_t shot, std::size_t most) {
  RaySample sample(most);
  for (std::uint32_t i = 0; i < shot; ++i) {
    core::Ray ray;
    ray.pixel = i;
    sample.offer(ray);
  }
  std::vector<std::uint32_t> kept;
  for (const core::Ray& ray : sample.rays()) {
    kept.push_back(ray.pixel);
  }
  return kept;
}

}  // namespace

TEST_CASE("a sample of rays keeps all of few and evenly many of more, in the order of the shots") {
  CHECK(kept_of(0, 10).empty());
  CHECK(kept_of(10, 10).size() == 10);
  const std::vector<std::uint32_t> kept = kept_of(10'000, 1000);
  CHECK(kept.size() > 400);
  CHECK(kept.size() <= 1000);
  CHECK(std::is_sorted(kept.begin(), kept.end()));
  const auto in_first_half = std::lower_bound(kept.begin(), kept.end(), 5000U) - kept.begin();
  CHECK(std::abs(static_cast<double>(in_first_half) / static_cast<double>(kept.size()) - 0.5) < 0.1);
}

TEST_CASE("a sample of rays favours neither of two that take turns") {
  const std::vector<std::uint32_t> kept = kept_of(10'000, 1000);
  const auto even = std::count_if(kept.begin(), kept.end(), [](std::uint32_t number) { return number % 2 == 0; });
  CHECK(std::abs(static_cast<double>(even) / static_cast<double>(kept.size()) - 0.5) < 0.1);
}

TEST_CASE("the rays recorded are those that the render counts, by class") {
  const apps::Subject subject = recorded_subject();
  const Recording recording = apps::record_rays(subject.database, subject.settings, plenty);
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer tracer(records, subject.settings.header, core::Skips{});
  core::Operations operations;
  core::render(tracer, subject.settings, operations);
  CHECK(recording.operations.rays == operations.rays);
  CHECK(recording.of(RayClass::primary).size() == operations.rays[0]);
  CHECK(recording.of(RayClass::shadow).size() == operations.rays[3]);
  CHECK(recording.of(RayClass::secondary).size() == operations.rays[1] + operations.rays[2]);
  CHECK(recording.of(RayClass::bounce).size() == operations.primary_hits);
  CHECK(operations.rays[1] > 0);
}

TEST_CASE("what is recorded has the same bits again") {
  const apps::Subject subject = recorded_subject("teapot-2");
  const Recording one = apps::record_rays(subject.database, subject.settings, 100);
  const Recording two = apps::record_rays(subject.database, subject.settings, 100);
  for (std::size_t i = 0; i < apps::ray_class_count; ++i) {
    CHECK(one.rays[i].size() <= 100);
    CHECK(same_bits(one.rays[i], two.rays[i]));
  }
}

TEST_CASE("a scene without mirrors has no secondary rays") {
  const apps::Subject subject = recorded_subject("tetra-2");
  CHECK(apps::record_rays(subject.database, subject.settings, plenty).of(RayClass::secondary).empty());
}

TEST_CASE("bounces leave a wall on the ray's side, by the cosine, and ignore the triangle they start on") {
  const apps::Subject subject = recorded_subject("tetra-2");
  const Recording recording = apps::record_rays(subject.database, subject.settings, plenty);
  const core::Ray& primary = recording.of(RayClass::primary)[24 * 8 + 12];
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer tracer(records, subject.settings.header, core::Skips{});
  core::Cursor cursor;
  core::Operations operations;
  REQUIRE(tracer.trace(primary, cursor, operations) == core::Traced::hit);
  core::HitState state = core::begin_shading(primary, cursor.best);
  core::Ray unused;
  const core::Shader shader(subject.settings.header, subject.settings.shade, subject.settings.skips, operations);
  shader.step(state, records.find(core::record_needed(state, subject.settings.header)), unused);
  double sum = 0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const core::Ray bounce =
        apps::bounce_ray(primary, cursor.best, records, subject.settings.header, static_cast<std::uint64_t>(i));
    const double cosine = core::dot(core::Vec3d(bounce.direction), state.normal);
    sum += cosine;
    CHECK(cosine > -1e-6);
    CHECK(std::fabs(core::length(core::Vec3d(bounce.direction)) - 1) < 1e-6);
    CHECK(bounce.ignored_primitive == cursor.best.primitive);
  }
  CHECK(std::fabs(sum / count - 2.0 / 3) < 0.02);  // the mean cosine of directions that the cosine weighs
}

}  // namespace dmpc::tests
