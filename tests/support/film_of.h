// The film of a database in one call, by the reference renderer.
#pragma once

#include <cstdint>

#include "core/database/database.h"
#include "core/picture/render.h"
#include "core/picture/surfaces/transport.h"
#include "core/record/records.h"
#include "core/scene/scene.h"
#include "core/trace/skips.h"

namespace dmpc::tests {

/// What is asked of a picture.
struct PathPicture {
  core::Transport transport;
  int width = 1, height = 1, samples = 1, bounces = 0;
  core::Skips skips = {};

  core::RenderSettings settings(const core::Database& database, const core::View& view) const {
    const core::ShadeOptions shade{
        .depth_max = bounces + 1, .first_samples = static_cast<std::uint32_t>(samples), .transport = transport};
    return {.header = database.header(),
            .camera = core::Camera(view, database.header().frame, width, height, samples),
            .shade = shade,
            .skips = skips};
  }
};

/// By the reference renderer; `operations` are added to. `detail`: as core::render() has it.
inline core::Film film_of(const core::Database& database, const core::RenderSettings& settings, core::Operations& operations,
                          const core::FineDetail* detail = nullptr) {
  core::LocalRecords records(database.bytes());
  core::GridTracer tracer(records, settings.header, settings.skips);
  return core::render(tracer, settings, operations, detail);
}
inline core::Film film_of(const core::Database& database, const core::RenderSettings& settings) {
  core::Operations operations;
  return film_of(database, settings, operations);
}

inline core::Film film_of(const core::Database& database, const core::View& view, const PathPicture& picture,
                          core::Operations& operations) {
  return film_of(database, picture.settings(database, view), operations);
}

inline core::Film film_of(const core::Database& database, const core::View& view, const PathPicture& picture) {
  core::Operations operations;
  return film_of(database, view, picture, operations);
}

}  // namespace dmpc::tests
