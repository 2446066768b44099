#include "core/picture/camera/frame_settings.h"

#include "core/base/expect.h"
#include "core/picture/camera/background.h"
#include "core/picture/ray_crowd.h"

namespace dmpc::core {

RenderSettings seen_by(const Camera& camera, const RenderSettings& settings, const Database& database) {
  expect(camera.width() == settings.camera.width() && camera.height() == settings.camera.height() &&
             camera.samples() == settings.camera.samples(),
         "frames are of one size");
  RenderSettings seen = settings;
  seen.camera = camera;
  seen.background = settings.skips.background ? find_background(database, camera) : BackgroundTiles();
  seen.shade.has_reflection_or_transmission = has_reflection_or_transmission(database);
  seen.shade.one_child_from = 0;
  seen.shade.one_child_from = settings.shade.transport.is_by_paths() ? std::uint8_t{0} : find_one_child_depth(database, seen);
  return seen;
}

}  // namespace dmpc::core
