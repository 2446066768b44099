// The one-thread reference renderer: what every strategy's film must equal, bit for bit.
#pragma once

#include "core/film.h"
#include "core/pixel_task.h"

namespace dmpc::core {

/// Renders every pixel in order with `tracer` (which never answers absent) and adds the work to `operations`.
template <Tracer T>
Film render(T& tracer, const RenderSettings& settings, Operations& operations);

}  // namespace dmpc::core
