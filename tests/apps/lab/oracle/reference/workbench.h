// A scene with both renderers ready to be compared on it.
#pragma once

#include <utility>

#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/ray_log.h"
#include "apps/lab/oracle/reference/scene.h"
#include "core/database/database.h"
#include "core/picture/pixel_task.h"
#include "core/picture/render.h"
#include "core/record/records.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// `side` x `side` pixels. What the accurate renderer is given may be changed on the way: then its errors should show.
struct Workbench {
  Workbench(core::Scene given, int side) : Workbench(given, given, side) {}
  Workbench(core::Scene given, const core::Scene& for_reference, int side)
      : scene(std::move(given)),
        database(core::build_database(scene, {})),
        settings(settings_of(scene, database, side)),
        reference(apps::reference_scene(for_reference)),
        finder(reference, scene.view.from),
        camera(scene.view, side, side),
        logger(database, settings, reference) {}
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  std::uint32_t pixel_count() const { return settings.camera.pixel_count(); }
  apps::ReferenceRay primary(std::uint32_t pixel) const {
    const auto width = static_cast<std::uint32_t>(camera.width());
    return camera.ray_through(pixel % width, pixel / width);
  }
  /// The product's, as it is rendered in one process.
  core::Film picture() const {
    core::LocalRecords records(database.bytes());
    core::GridTracer tracer(records, settings.header, settings.skips);
    core::Operations operations;
    return core::render(tracer, settings, operations);
  }
  apps::RayLog reference_log_of_rays(std::uint32_t pixel) const {
    return apps::reference_log_of_rays(reference, finder, settings.shade, primary(pixel));
  }

  static core::RenderSettings settings_of(const core::Scene& scene, const core::Database& database, int side) {
    const core::Camera camera(scene.view, database.header().frame, side, side, 1);
    return {database.header(), camera, {.pixel_share = scene.textures.empty() ? 0.0 : 1.0}};
  }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
  apps::ReferenceScene reference;
  apps::ReferenceFinder finder;
  apps::ReferenceCamera camera;
  apps::ProductLogger logger;
};

}  // namespace dmpc::tests
