// A built-in scene, built for a small picture: for tests that know no file and no command.
#pragma once

#include <cstddef>

#include "core/database/database.h"
#include "core/families/scenes.h"
#include "core/picture/camera/camera.h"
#include "core/picture/render.h"
#include "core/scene/scene.h"
#include "tests/support/film_of.h"

namespace dmpc::tests {

/// A built-in scene, small, with what rendering it needs.
struct BuiltScene {
  BuiltScene(const char* name, std::size_t page_size_bytes, int side)
      : scene(core::built_in_scene(core::parse_scene_name(name))),
        database(core::build_database(scene, {.page_size_bytes = page_size_bytes})),
        settings{database.header(), core::Camera(scene.view, database.header().frame, side, side, 1), {}} {}

  core::Film reference(core::Operations& operations) const { return film_of(database, settings, operations); }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
};

}  // namespace dmpc::tests
