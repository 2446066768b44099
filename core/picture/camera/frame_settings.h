// Settings for the next frame: what changes when the camera moves.
#pragma once

#include "core/database/database.h"
#include "core/picture/camera/camera.h"
#include "core/picture/pixel_task.h"

namespace dmpc::core {

/// `settings` with this camera, which has as many pixels and samples, and with what depends on its position: the background
/// tiles, and the depth from which a crowded picture sends fewer rays. Everything else, such as the sky's up, stays. Reads
/// database.bytes(). Thread safety: pure.
RenderSettings seen_by(const Camera& camera, const RenderSettings& settings, const Database& database);

}  // namespace dmpc::core
