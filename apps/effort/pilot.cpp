#include "apps/effort/pilot.h"

#include <time.h>

#include <cstdint>
#include <vector>

#include "apps/edge/system/stopwatch.h"
#include "core/picture/render.h"
#include "core/trace/operations.h"

namespace dmpc::apps {
namespace {

constexpr double pilot_seconds_max = 0.25;
/// Odd and near to what is left of the golden ratio: its multiples go all over the picture, and soon.
constexpr std::uint64_t stride = 2'654'435'761;

}  // namespace

double picture_seconds(const core::Database& database, const core::RenderSettings& settings) {
  core::LocalRecords records(database.bytes());
  core::GridTracer tracer(records, settings.header, settings.skips);
  core::Operations operations;
  std::vector<core::HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  const std::uint64_t pixels = settings.camera.pixel_count();
  ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
  double seconds = 0;
  std::uint64_t done = 0;
  core::with_pixel_task(settings.header, stack, [&](auto& task) {
    for (; done < pixels && seconds < pilot_seconds_max; ++done) {
      const auto pixel = static_cast<std::uint32_t>(done * stride % pixels);
      core::render_pixel(task, pixel, settings.first_samples(), tracer, settings, operations);
      seconds += stopwatch.lap();
    }
  });
  return seconds * static_cast<double>(pixels) / static_cast<double>(done);
}

}  // namespace dmpc::apps
