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

/// Times the phase `render` by PlainRenderer on 1 and 2 threads, and of our own by all plain_contenders(), one of them beside
/// busy processes, too; whole commands of command_contenders(); the writing of the file; and ranks, if there is an mpirun. Each
/// is held against the plain renderer on 2 threads, some against each other. Compares rays shot, and what building took. Leaves
/// out scenes with textures, which it says on stderr, as why ranks are left out. Throws core::InputError, too, if the program
/// cannot be run; core::InternalError if our films are not one or the plain picture is another.
MeasurePart measure_plain;
/// Times the phase `render` by PlainPathRenderer on 1 and 2 threads, and of our own replicated on 1 node and by svm on 2, with
/// the same samples and chances, so to the same error, and compares rays: of each scene as it is, and as light_and_polish() makes
/// it. Leaves out scenes with textures, which it says on stderr. Throws core::InternalError if our films are not one or the plain
/// picture is not ours within its noise.
MeasurePart measure_paths;
/// Records each scene's rays and lets everybody trace them, class by class, as closest and as any hit, on each number of threads,
/// all in every round.
MeasurePart measure_kernel;
/// Renders each scene as `render` does, on two nodes: with svm and our grid, and replicated with Embree, whose tree is built
/// within its phase `render`.
MeasurePart measure_picture;
/// Times the phase `render` with svm on 2, 8 and 64 nodes whose caches hold all pages, on 8 with caches of a part of the
/// database, and with dataflow on 2 and 64. The films are expected to be one. Then, of no scene, items of more and more work on
/// 64 nodes (smallest_item.h).
MeasurePart measure_emulation;
/// Builds each scene's database and two of Embree's trees, the robust one and the fast one of high quality, on each number of
/// threads. Embree's time is its tree's alone, from vertices that lie ready; ours is from the scene to the pages.
MeasurePart measure_build;
/// Writes each scene's triangles as a PLY and as a GLB file, and times reading them as a scene, and by Assimp alone.
MeasurePart measure_load;
/// Runs `dmpc render` on 8 nodes as a process of its own, for each scene and for one of a single triangle, and holds the most
/// anonymous memory that it ever had, above the triangle's, against the sum of the nodes' local memories. Once: nothing is timed.
/// Throws core::InputError if the program cannot be run, too.
MeasurePart measure_memory;
/// Counts KB and distinct pages a pixel of each scene that the article has, once: nothing is timed. Rays are counted by the
/// article's convention.
MeasurePart measure_pages;

}  // namespace dmpc::apps
