#include "apps/lab/bench/error/path_reference.h"

#include <bit>
#include <chrono>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "core/base/expect.h"
#include "core/database/parallel.h"
#include "core/picture/render.h"

namespace dmpc::apps {
namespace {

core::Vec3d light_of(const core::PixelSums& sums, std::uint32_t samples, core::FilmScale scale) {
  core::Vec3d light;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    light[channel] = (static_cast<double>(sums.plane[0].channel[channel]) + static_cast<double>(sums.plane[1].channel[channel])) *
                     (core::film_resolution / scale.factor() / samples);
  }
  return light;
}

/// The differences of one row's halves, and its rays.
struct RowFigures : HalvesSum {
  std::uint64_t rays = 0;
};

/// One thread's renderer of a row.
class RowRenderer {
 public:
  RowRenderer(const core::Database& database, const core::RenderSettings& settings, std::uint32_t samples)
      : settings_(settings),
        half_(samples / 2),
        records_(database.bytes()),
        tracer_(records_, settings.header, settings.skips),
        stack_(static_cast<std::size_t>(core::waiting_hits_max(settings.shade, settings.skips))) {}

  RowFigures render(int row, Reference& reference) {
    RowFigures figures;
    core::Operations operations;
    const auto width = static_cast<std::uint32_t>(settings_.camera.width());
    for (std::uint32_t pixel = static_cast<std::uint32_t>(row) * width; pixel < (static_cast<std::uint32_t>(row) + 1) * width;
         ++pixel) {
      const core::Vec3d a = half(pixel, path_reference_first, operations);
      figures.add(pixel, a, half(pixel, path_reference_first + half_, operations), reference);
    }
    figures.rays = operations.ray_count();
    return figures;
  }

 private:
  core::Vec3d half(std::uint32_t pixel, std::uint32_t first, core::Operations& operations) {
    core::PixelTask task(stack_);
    return light_of(core::render_pixel(task, pixel, {first, half_}, tracer_, settings_, operations), half_,
                    settings_.shade.film_scale);
  }

  const core::RenderSettings& settings_;
  std::uint32_t half_;
  core::LocalRecords records_;
  core::GridTracer<core::LocalRecords> tracer_;
  std::vector<core::HitState> stack_;
};

}  // namespace

Reference path_reference(const core::Database& database, const core::RenderSettings& settings, std::uint32_t samples,
                         const Attendance& attendance) {
  core::expect(std::has_single_bit(samples) && samples >= 2 && samples <= path_reference_first,
               "a path reference has two leaves of a sequence");
  const auto start = std::chrono::steady_clock::now();
  const auto rows = static_cast<std::size_t>(settings.camera.height());
  Reference reference;
  reference.picture = reference.difference = Image(settings.camera.width(), settings.camera.height());
  std::vector<RowFigures> figures(rows);
  std::uint64_t done = 0;
  const core::Parallel parallel(0);
  parallel.for_each(
      rows,
      [&](std::size_t row) {
        if (!attendance.stop.stop_requested()) {
          figures[row] = RowRenderer(database, settings, samples).render(static_cast<int>(row), reference);
        }
      },
      [&](std::size_t) { attendance.progress(++done, rows); });
  if (attendance.stop.stop_requested()) {
    throw Interrupted();
  }
  HalvesSum sum;
  for (const RowFigures& row : figures) {
    sum.squares += row.squares;
    sum.relative_squares += row.relative_squares;
    reference.rays += row.rays;
  }
  sum.finish(reference);
  reference.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return reference;
}

}  // namespace dmpc::apps
