#include "apps/lab/oracle/reference/picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "apps/frontend/system/interrupt.h"
#include "apps/lab/oracle/reference/tracer.h"

namespace dmpc::apps {
namespace {

/// Maximum rate of progress reports.
constexpr int band_count = 200;
/// Rows that keep the cores of a large machine busy until the last is done.
constexpr int band_rows_min = 8;

core::Vec3d pixel_radiance(ReferenceTracer& tracer, const ReferenceCamera& camera, const SamplePattern& pattern, int column,
                           int row) {
  const auto pixel =
      static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(camera.width()) + static_cast<std::uint32_t>(column);
  core::Vec3d sum;
  for (std::uint32_t sample = 0; sample < pattern.count(); ++sample) {
    const SamplePosition offset = pattern.position(pixel, sample);
    ReferenceRay ray = camera.ray_through(column + offset.column, row + offset.row);
    ray.pixel = pixel;
    ray.sample = sample;
    sum = sum + tracer.radiance(ray);
  }
  return sum * (1.0 / pattern.count());
}

}  // namespace

ReferencePicture render_accurately(const ReferenceScene& scene, const ReferenceFinder& finder, const ReferenceCamera& camera,
                                   const SamplePattern& pattern, const core::ShadeOptions& options,
                                   const Attendance& attendance) {
  const int width = camera.width(), height = camera.height();
  ReferencePicture picture{width, height, {}, 0};
  picture.radiance.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<std::uint64_t> rays(static_cast<std::size_t>(height));
  const auto render_row = [&](int row) {
    ReferenceTracer tracer(scene, finder, options);
    for (int column = 0; column < width; ++column) {
      const auto pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
      picture.radiance[pixel] = pixel_radiance(tracer, camera, pattern, column, row);
    }
    rays[static_cast<std::size_t>(row)] = tracer.rays();
  };
  const int band = std::max(height / band_count, band_rows_min);
  for (int first = 0; first < height; first += band) {
    attendance.progress(static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(height));
    if (attendance.stop.stop_requested()) {
      throw Interrupted();
    }
    tbb::parallel_for(first, std::min(first + band, height), render_row);
  }
  attendance.progress(static_cast<std::uint64_t>(height), static_cast<std::uint64_t>(height));
  picture.rays = std::accumulate(rays.begin(), rays.end(), std::uint64_t{0});
  return picture;
}

}  // namespace dmpc::apps
