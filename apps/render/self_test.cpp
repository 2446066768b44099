#include "apps/render/self_test.h"

#include <array>
#include <memory>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/digest.h"
#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/picture/bundle_task.h"
#include "core/picture/render.h"
#include "core/record/records.h"

namespace dmpc::apps {

namespace {

/// A pixel a bundle, four rows of four in a square.
constexpr int side = 48;
constexpr std::uint32_t pixels_together = core::BundleTask::pixels_max;

/// As core::render(), but traverses bundles of rays.
core::Film render_in_bundles(core::GridTracer<core::LocalRecords>& tracer, const core::RenderSettings& settings,
                             core::Operations& operations) {
  core::Film film(side, side);
  std::vector<core::BundleHit> stack(static_cast<std::size_t>(settings.shade.depth_max));
  const auto task = std::make_unique<core::BundleTask>(stack);
  std::array<std::uint32_t, pixels_together> pixels{};
  std::array<core::SampleStep, pixels_together> steps;
  steps.fill(core::SampleStep::first());
  for (std::uint32_t first = 0; first < settings.camera.pixel_count(); first += pixels_together) {
    for (std::uint32_t i = 0; i < pixels_together; ++i) {
      pixels[i] = first + i;
    }
    task->start(pixels, steps, settings, operations);
    while (task->run(tracer, settings, operations) != core::TaskState::finished) {
    }
    for (std::uint32_t i = 0; i < pixels_together; ++i) {
      film.deposit(first + i, task->sums(i));
    }
  }
  return film;
}

void add_scene(const char* name, Digest& databases, Digest& pictures) {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name(name));
  const core::Database database = core::build_database(scene, {.threads = 1});
  const core::RenderSettings settings{
      database.header(), core::Camera(scene.view, database.header().frame, side, side, 1), {.depth_max = 5}};
  core::LocalRecords records(database.bytes());
  core::GridTracer<core::LocalRecords> tracer(records, database.header(), core::Skips{});
  core::Operations operations;
  databases.add(database.bytes());
  pictures.add(core::render(tracer, settings, operations).hash());
  pictures.add(render_in_bundles(tracer, settings, operations).hash());
}

}  // namespace

SelfTest self_test() {
  Digest databases, pictures;
  add_scene("mount-3", databases, pictures);  // triangles, and spheres of glass
  add_scene("rings-1", databases, pictures);  // spheres and cylinders that mirror
  return {databases.value(), pictures.value()};
}

Compatibility renderer_compatibility() {
  const SelfTest test = self_test();
  Compatibility compatibility = call_compatibility();
  compatibility.emplace_back("digest of databases", hash_text(test.databases));
  compatibility.emplace_back("digest of self-test rays", hash_text(test.pictures));
  return compatibility;
}

}  // namespace dmpc::apps
