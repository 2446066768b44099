#include "apps/lab/bench/speed/recording.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/picture/render.h"

namespace dmpc::tests::recording_test {

using apps::BundleSample;
using apps::RayClass;
using apps::Recording;

namespace {

constexpr std::size_t plenty = 1'000'000;

apps::Subject recorded_subject(const std::string& scene = "balls-1") {
  apps::PictureOptions picture;
  picture.scene = scene;
  picture.resolution = {24, 16};
  return build_subject(load_scene(picture), picture);
}

constexpr std::uint32_t rays_each = 3;

/// What is kept of bundles of equal size whose rays have the bundle's number as their pixel: 0, 1, 2, ...
apps::BundledRays kept_of(std::uint32_t shot, std::size_t most) {
  BundleSample sample(most);
  for (std::uint32_t i = 0; i < shot; ++i) {
    std::array<core::Ray, rays_each> rays;
    std::for_each(rays.begin(), rays.end(), [&](core::Ray& ray) { ray.pixel = i; });
    sample.offer(rays);
  }
  return sample.bundles();
}

std::vector<std::uint32_t> numbers_of(const apps::BundledRays& kept) {
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < kept.bundles().count(); ++i) {
    numbers.push_back(kept.bundles().bundle(i).front().pixel);
  }
  return numbers;
}

bool same_rays(std::span<const core::Ray> a, std::span<const core::Ray> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// Whether `sampled` are bundles of `all`, in their order.
bool are_whole(const apps::BundleSpan& sampled, const apps::BundleSpan& all) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < sampled.count(); ++i) {
    while (next < all.count() && !same_rays(sampled.bundle(i), all.bundle(next))) {
      ++next;
    }
    if (next++ >= all.count()) {
      return false;
    }
  }
  return true;
}

core::Ray first_that_hits(core::GridTracer<core::LocalRecords>& tracer, const apps::BundledRays& rays, core::Hit& hit) {
  for (const core::Ray& ray : rays.rays) {
    core::Cursor cursor;
    core::Operations operations;
    if (tracer.trace(ray, cursor, operations) == core::Traced::hit) {
      hit = cursor.best;
      return ray;
    }
  }
  FAIL("no ray hits");
  return {};
}

}  // namespace

TEST_CASE("a sample of bundles keeps all of few and evenly many of more, in the order of the shots") {
  CHECK(kept_of(0, 30).bundles().count() == 0);
  CHECK(kept_of(10, 30).bundles().count() == 10);
  const apps::BundledRays sampled = kept_of(10'000, 3000);
  CHECK(sampled.rays.size() > 1200);
  CHECK(sampled.rays.size() <= 3000);
  const std::vector<std::uint32_t> kept = numbers_of(sampled);
  CHECK(std::is_sorted(kept.begin(), kept.end()));
  const auto in_first_half = std::lower_bound(kept.begin(), kept.end(), 5000U) - kept.begin();
  CHECK(std::abs(static_cast<double>(in_first_half) / static_cast<double>(kept.size()) - 0.5) < 0.1);
}

TEST_CASE("a part of some bundles cuts none of them") {
  const apps::BundledRays kept = kept_of(10, 30);
  const apps::BundleSpan part = kept.bundles().part(4, 4), rest = kept.bundles().part(8, 4), none = kept.bundles().part(10, 4);
  CHECK(part.count() == 4);
  CHECK(part.rays().size() == 4 * rays_each);
  CHECK(part.rays().front().pixel == 4);
  CHECK(part.bundle(3).size() == rays_each);
  CHECK(part.bundle(3).back().pixel == 7);
  CHECK(rest.count() == 2);
  CHECK(rest.rays().back().pixel == 9);
  CHECK(none.count() == 0);
  CHECK(none.rays().empty());
}

TEST_CASE("sampled bundles are whole, and up to 16 rays of one kind") {
  const apps::Subject subject = recorded_subject();
  const Recording all = apps::record_rays(subject.database, subject.settings, plenty);
  const Recording few = apps::record_rays(subject.database, subject.settings, 200);
  for (std::size_t i = 0; i < apps::ray_class_count; ++i) {
    const apps::BundleSpan bundles = all.rays[i].bundles();
    CAPTURE(std::string(name_of(RayClass{static_cast<std::uint8_t>(i)})));
    CHECK(few.rays[i].rays.size() <= 200);
    CHECK(few.rays[i].bundles().count() > 0);
    CHECK(are_whole(few.rays[i].bundles(), bundles));
    for (std::size_t k = 0; k < bundles.count(); ++k) {
      const std::span<const core::Ray> rays = bundles.bundle(k);
      CHECK((!rays.empty() && rays.size() <= core::bundle_rays_max));
      CHECK(std::all_of(rays.begin(), rays.end(), [&](const core::Ray& ray) { return ray.kind == rays[0].kind; }));
    }
  }
}

TEST_CASE("primary rays are bundles of 4x4 pixels") {
  const apps::Subject subject = recorded_subject();
  const Recording recording = apps::record_rays(subject.database, subject.settings, plenty);
  const apps::BundleSpan bundles = recording.of(RayClass::primary).bundles();
  REQUIRE(bundles.count() == 6 * 4);
  for (std::uint32_t i = 0; i < 16; ++i) {
    CHECK(bundles.bundle(7)[i].pixel == (4 + i / 4) * 24 + 4 + i % 4);
  }
}

TEST_CASE("the rays recorded are those that the render counts, by class") {
  const apps::Subject subject = recorded_subject();
  const Recording recording = apps::record_rays(subject.database, subject.settings, plenty);
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer tracer(records, subject.settings.header, core::Skips{});
  core::Operations operations;
  core::render(tracer, subject.settings, operations);
  CHECK(recording.operations.rays == operations.rays);
  CHECK(recording.of(RayClass::primary).rays.size() == operations.rays[0]);
  CHECK(recording.of(RayClass::shadow).rays.size() == operations.rays[3]);
  CHECK(recording.of(RayClass::secondary).rays.size() == operations.rays[1] + operations.rays[2]);
  CHECK(recording.of(RayClass::bounce).rays.size() == operations.primary_hits);
  CHECK(operations.rays[1] > 0);
}

TEST_CASE("bounces leave a wall on the ray's side, by the cosine, and ignore the triangle they start on") {
  const apps::Subject subject = recorded_subject("tetra-2");
  const Recording recording = apps::record_rays(subject.database, subject.settings, plenty);
  core::LocalRecords records(subject.database.bytes());
  core::GridTracer tracer(records, subject.settings.header, core::Skips{});
  core::Operations operations;
  core::Hit hit;
  const core::Ray primary = first_that_hits(tracer, recording.of(RayClass::primary), hit);
  core::HitState state = core::begin_shading(primary, hit);
  core::Ray unused;
  const core::Shader shader(subject.settings.header, subject.settings.shade, subject.settings.skips, operations);
  shader.step(state, records.find(core::record_needed(state, subject.settings.header)), unused);
  double sum = 0;
  constexpr int count = 4000;
  for (int i = 0; i < count; ++i) {
    const core::Ray bounce = apps::bounce_ray(primary, hit, records, subject.settings.header, static_cast<std::uint64_t>(i));
    const double cosine = core::dot(core::Vec3d(bounce.direction), state.normal);
    sum += cosine;
    CHECK(cosine > -1e-6);
    CHECK(std::fabs(core::length(core::Vec3d(bounce.direction)) - 1) < 1e-6);
    CHECK(bounce.ignored_primitive == hit.primitive);
  }
  CHECK(std::fabs(sum / count - 2.0 / 3) < 0.02);  // the mean cosine of directions that the cosine weighs
}

}  // namespace dmpc::tests::recording_test
