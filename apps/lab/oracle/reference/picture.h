// A whole picture by the reference renderer.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "apps/lab/oracle/reference/camera.h"
#include "apps/lab/oracle/reference/finder.h"
#include "apps/lab/oracle/reference/samples.h"
#include "apps/lab/oracle/reference/scene.h"
#include "core/picture/shade.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel, row by row from the top left.
struct ReferencePicture {
  int width = 0, height = 0;
  std::vector<core::Vec3d> radiance;
  std::uint64_t rays = 0;  ///< rays of all kinds
};

/// Receives progress, and may end the render.
struct Attendance {
  /// Called on the calling thread between bands of rows: (done, in all), in rows.
  std::function<void(std::uint64_t, std::uint64_t)> progress = [](std::uint64_t, std::uint64_t) {};
  std::stop_token stop;
};

/// Renders with all cores; the bits are the same for every number of them. `finder` is made from `scene`. Throws Interrupted when
/// a stop is requested.
ReferencePicture render_accurately(const ReferenceScene& scene, const ReferenceFinder& finder, const ReferenceCamera& camera,
                                   const SamplePattern& pattern, const core::ShadeOptions& options,
                                   const Attendance& attendance = {});

}  // namespace dmpc::apps
