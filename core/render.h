// The one-thread reference renderer: what every strategy's film must equal, bit for bit.
#pragma once

#include <vector>

#include "core/expect.h"
#include "core/film.h"
#include "core/pixel_task.h"

namespace dmpc::core {

/// Renders every pixel in order with `tracer` (which never answers absent) and adds the work to `operations`.
template <Tracer T>
Film render(T& tracer, const RenderSettings& settings, Operations& operations) {
  Film film(settings.camera.width(), settings.camera.height());
  std::vector<HitState> stack(static_cast<std::size_t>(settings.shade.depth_max));
  PixelTask task(stack);
  for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count(); ++pixel) {
    task.start(pixel, settings, operations);
    TaskState state = TaskState::more;
    while (state != TaskState::finished) {
      state = task.run(tracer, settings, operations);
      expect(state != TaskState::absent, "the reference renderer has every record");
    }
    film.deposit(pixel, task.sums());
  }
  return film;
}

}  // namespace dmpc::core
