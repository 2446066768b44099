// Frames: pictures of a scene one after another, from place to place.
#pragma once

#include <initializer_list>
#include <vector>

#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/picture/camera/camera.h"
#include "core/picture/camera/frame_settings.h"
#include "core/scene/scene.h"

namespace dmpc::tests {

/// Each of them is seen from this much farther to the right than the scene's own.
struct Walk {
  explicit Walk(int side, const core::BuildOptions& build = {.page_size_bytes = 512},
                std::initializer_list<double> steps = {0, 0.02, 0.04})
      : scene(core::built_in_scene(core::parse_scene_name("teapot-4"))), database(core::build_database(scene, build)) {
    const core::RenderSettings own{database.header(), camera(scene.view, side), {}};
    for (const double step : steps) {
      core::View view = scene.view;
      view.from.x += step;
      frames.push_back(core::seen_by(camera(view, side), own, database));
    }
  }

  core::Camera camera(const core::View& view, int side) const { return {view, database.header().frame, side, side, 1}; }

  core::Scene scene;
  core::Database database;
  std::vector<core::RenderSettings> frames;
};

}  // namespace dmpc::tests
