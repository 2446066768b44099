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
/// Times the phase `render` by PlainRenderer, by paths, on 1 and 2 threads, and of our own replicated on 1 node and by svm on 2,
/// with the same samples and chances, so to the same error, and compares rays: of each scene as it is, and as light_and_polish()
/// makes it. Leaves out scenes with textures, which it says on stderr. Throws core::InternalError if our films are not one or the
/// plain picture is not ours within its noise.
MeasurePart measure_paths;
/// Records each scene's rays and lets everybody trace them, class by class, as closest and as any hit, on each number of threads,
/// all in every round.
MeasurePart measure_kernel;
/// Times the phase `render` with svm on 8 nodes whose caches hold all pages, or a part of the database. The films are expected to
/// be one. Then, of no scene, items of more and more work on 64 nodes (question_ring.h).
MeasurePart measure_emulation;
/// Builds each scene's database and two of Embree's trees, the robust one and the fast one of high quality, on each number of
/// threads. Embree's time is its tree's alone, from vertices that lie ready; ours is from the scene to the pages.
MeasurePart measure_build;
/// Runs `dmpc render` on 8 nodes as a process of its own, for each scene and for one of a single triangle, and holds the most
/// anonymous memory that it ever had, above the triangle's, against the sum of the nodes' local memories. Once: nothing is timed.
/// Throws core::InputError if the program cannot be run, too.
MeasurePart measure_memory;
/// Counts KB and distinct pages a pixel of each scene that the article has, once: nothing is timed. Rays are counted by the
/// article's convention.
MeasurePart measure_pages;
/// Renders each scene with all skips on, all off and each off by itself, with two cutoffs, and once more with all on, to show
/// what noise does, all of them in every round: svm on 2 nodes; for what only dataflow skips, that on 64. Compares processor
/// time, with what a skip takes to prepare, and counted operations by their prices (core/trace/work.h), in which messages do not
/// count; of a cutoff the error, too. Throws core::InternalError if an exact skip changes a film.
MeasurePart measure_ablation;

}  // namespace dmpc::apps
