// All our own beside a plain renderer in `bench speed`.
#pragma once

#include <string>
#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/bench/speed/plain_renderer.h"
#include "core/picture/film.h"

namespace dmpc::apps {

/// The most, root mean square, that a picture of the plain renderer may lie from ours, in linear radiance.
inline constexpr double plain_error_max = 1.0 / 255;

/// How far it lies from our film of `scene`. Throws core::InternalError if that is more than plain_error_max.
double distance_to_ours(const PlainPicture& picture, const core::Film& film, const std::string& scene);

/// Times the phase `render` of each scene by PlainRenderer on 1 and 2 threads, by svm on 1, 2, 8 and 64 nodes, by dataflow and
/// replicated, and by svm on a modelled machine, each held against the plain renderer on 2 threads; compares rays shot, and what
/// building took. Leaves out scenes with textures, which it says on stderr. `results` and progress as measure_kernel()'s; throws
/// as it does, and core::InternalError if our films are not one or the plain picture is another.
void measure_plain(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

}  // namespace dmpc::apps
