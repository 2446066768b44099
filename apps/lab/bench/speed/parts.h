// What each part of `bench speed` measures.
#pragma once

#include <vector>

#include "apps/edge/system/interrupt.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"

namespace dmpc::apps {

/// Measures the part on each of its scenes, in rounds where it is timed. `results` has what is measured so far at any time,
/// thrown at or not. Progress goes to stderr if that is a terminal. Throws Interrupted after a signal; core::InputError for a
/// scene that will not do.
using MeasurePart = void(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

/// Times the phase `render` by PlainRenderer on 1 and 2 threads, and of our own on many computers, and some as whole commands.
/// Each is held against the plain renderer on 2 threads. Compares rays shot, and what building took. Leaves out scenes with
/// textures, which it says on stderr. Throws core::InputError, too, if the program cannot be run; core::InternalError if our
/// films are not one or the plain picture is another.
MeasurePart measure_plain;
/// Of a scene of 1987 one for a path tracer of today: point lights become balls that shine, of a radius of a twentieth of the
/// diagonal of all objects (core::make_lights_spheres()); what mirrors becomes a metal as far as it does, whose tiny mirrors have
/// a roughness of 0.3. What has tiny mirrors already keeps them.
void light_and_polish(core::Scene& scene);
/// Times the phase `render` by PlainRenderer, by paths, on 1 and 2 threads, and of our own replicated on 1 node and by svm on 2,
/// with the same samples and chances, so to the same error, and compares rays: of each scene as it is, and as light_and_polish()
/// makes it. Leaves out scenes with textures, which it says on stderr. Throws core::InternalError if our films are not one or the
/// plain picture is not ours within its noise.
MeasurePart measure_paths;
/// Records each scene's rays and lets everybody trace them, class by class, as closest and as any hit, on each number of threads,
/// all in every round.
MeasurePart measure_kernel;
/// Times the phase `render` with svm on 8 nodes whose caches hold all pages, or a part of the database. The films are expected to
/// be one.
MeasurePart measure_emulation;
/// Renders each scene with all skips on, all off and each off by itself, with two cutoffs, and once more with all on, to show
/// what noise does, all of them in every round: svm on 2 nodes; for what only dataflow skips, that on 64. Compares processor
/// time, with what a skip takes to prepare, and counted operations by their prices (core/trace/work.h), in which messages do not
/// count; of a cutoff the error, too. Throws core::InternalError if an exact skip changes a film.
MeasurePart measure_ablation;

}  // namespace dmpc::apps
