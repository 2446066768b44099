// The parts of `bench speed`, what is chosen for all of them, and what each measures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/frontend/system/distinct_files.h"
#include "apps/frontend/system/interrupt.h"
#include "apps/scene/picture_options.h"
#include "apps/scene/subject.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// plain: all our own beside a plain renderer. paths: light along paths beside a plain path tracer. kernel: rays a second.
/// emulation: small caches. ablation: what skips are worth.
enum class SpeedPart : std::uint8_t { plain, paths, kernel, emulation, ablation };
inline constexpr std::size_t speed_part_count = 5;

/// As the command line and the table call it.
const char* name_of(SpeedPart part);
/// The parts that compare speeds: all but ablation, which has to be named.
std::set<SpeedPart> all_speed_parts();
/// "kernel,plain". Throws core::UsageError for anything that is none, listing those that there are.
std::set<SpeedPart> parse_speed_parts(const std::string& text);

struct SpeedSettings {
  std::vector<std::string> scenes;           ///< none: those of each part
  bool is_quick = false;                     ///< fewer rays, rounds, pixels and large scenes
  std::optional<std::size_t> rounds;         ///< nothing: what the part takes
  std::vector<std::uint32_t> thread_counts;  ///< for the part `kernel`, each once, ascending
  std::optional<Resolution> resolution;      ///< nothing: what the part takes
  std::filesystem::path program;             ///< dmpc itself, to be run as a process of its own
  std::vector<NamedFile> outputs;            ///< none of which may be a file that a scene is read from

  SpeedSettings();  ///< one thread and all cores

  std::vector<std::string> scenes_of(SpeedPart part) const;
  std::size_t rounds_of(SpeedPart part) const;
  /// One sample a pixel, at depth 5; of paths 16 with three bounces under a white sky.
  PictureOptions picture_of(SpeedPart part, const std::string& scene) const;
  /// Throws as load_scene_beside().
  core::Scene load(const PictureOptions& picture) const;
  /// The part's picture of it, ready to be rendered. Throws as load().
  Subject subject_of(SpeedPart part, const std::string& scene) const;
  /// So many rays of each class are in the kernel's part.
  std::size_t rays_max() const { return is_quick ? 20'000 : 200'000; }
};

/// "1,2,8" as ascending numbers without repetition, each 1 to 1024. Throws core::UsageError for anything else.
std::vector<std::uint32_t> parse_thread_counts(const std::string& text);

struct Comparison;

/// Measures the part on each of its scenes, in rounds where it is timed. `results` has what is measured so far at any time,
/// thrown at or not. Progress goes to stderr if that is a terminal. Throws Interrupted after a signal; core::InputError for a
/// scene that will not do.
using MeasurePart = void(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

/// Times the phase `render` by PlainRenderer on 1 and 2 threads, and of our own on many computers, and some as whole commands.
/// Each is held against the plain renderer on 2 threads. Compares rays shot, and what building took. Leaves out scenes with
/// textures, which it says on stderr. Throws core::InputError, too, if the program cannot be run; core::InternalError if our
/// films are not one or the plain picture is another.
MeasurePart measure_plain;
/// Turns a scene of 1987 into one for a path tracer of today: point lights become emitting spheres with a radius of a twentieth
/// of the diagonal of all objects (core::make_lights_spheres()); mirrors become metals with the same reflectance and microfacets
/// of roughness 0.3. Surfaces that have microfacets already keep them.
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
