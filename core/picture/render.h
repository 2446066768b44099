// The one-thread reference renderer: what every strategy's film must equal, bit for bit.
#pragma once

#include <vector>

#include "core/base/expect.h"
#include "core/picture/film/film.h"
#include "core/picture/pixel_task.h"

namespace dmpc::core {

/// Renders the samples of one pixel with `tracer`, which never returns absent, and adds the work to `operations`.
template <class Task, Tracer T>
PixelSums render_pixel(Task& task, std::uint32_t pixel, const SampleRange& samples, T& tracer, const RenderSettings& settings,
                       Operations& operations) {
  task.start(pixel, samples, settings, operations);
  TaskState state = TaskState::more;
  while (state != TaskState::finished) {
    state = task.run(tracer, settings, operations);
    expect(state != TaskState::absent, "the reference renderer has every record");
  }
  return task.sums();
}

/// Renders every pixel in order, pass after pass. `detail`: the picture's find_fine_detail(), if it is refined.
template <Tracer T>
Film render(T& tracer, const RenderSettings& settings, Operations& operations, const FineDetail* detail = nullptr) {
  const int width = settings.camera.width(), height = settings.camera.height();
  Film film(width, height, settings.shade.film_scale, planes_for(settings.first_samples().count));
  Refinement refinement(settings.refinement, settings.first_samples().count, width, height, detail, film.scale());
  std::vector<HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  with_pixel_task(settings.header, stack, [&](auto& task) {
    do {
      for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count(); ++pixel) {
        if (refinement.pass().has(pixel)) {
          film.deposit(pixel, render_pixel(task, pixel, refinement.pass().samples(pixel), tracer, settings, operations));
        }
      }
    } while (refinement.next_pass(film));
  });
  return film;
}

}  // namespace dmpc::core
