// A whole picture by the accurate renderer.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "apps/lab/oracle/accurate/camera.h"
#include "apps/lab/oracle/accurate/finder.h"
#include "apps/lab/oracle/accurate/samples.h"
#include "apps/lab/oracle/accurate/scene.h"
#include "core/picture/shade.h"

namespace dmpc::apps {

/// Mean linear radiance of each pixel, row by row from the top left.
struct AccuratePicture {
  int width = 0, height = 0;
  std::vector<core::Vec3d> radiance;
  std::uint64_t rays = 0;  ///< of all kinds
};

/// Who is told, and who may end it.
struct Attendance {
  /// Called on the calling thread between bands of rows: (done, in all), in rows.
  std::function<void(std::uint64_t, std::uint64_t)> progress = [](std::uint64_t, std::uint64_t) {};
  std::stop_token stop;
};

/// Renders with all cores; the same bits for every number of them. `finder` is made of `scene`. Throws Interrupted when a stop is
/// requested.
AccuratePicture render_accurately(const AccurateScene& scene, const AccurateFinder& finder, const AccurateCamera& camera,
                                  const SamplePattern& pattern, const core::ShadeOptions& options,
                                  const Attendance& attendance = {});

}  // namespace dmpc::apps
