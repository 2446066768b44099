// The parts of `bench speed`, their common settings, and what each measures.
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

/// plain: our renderer against a plain renderer. paths: path tracing against a plain path tracer. kernel: rays per second.
/// emulation: small caches. ablation: the gain of skips.
enum class SpeedPart : std::uint8_t { plain, paths, kernel, emulation, ablation };
inline constexpr std::size_t speed_part_count = 5;

const char* name_of(SpeedPart part);
/// Returns the parts that compare speeds: all except ablation, which has to be named.
std::set<SpeedPart> all_speed_parts();
/// Parses "kernel,plain". Throws core::UsageError, which lists the known parts, for anything else.
std::set<SpeedPart> parse_speed_parts(const std::string& text);

struct SpeedSettings {
  std::vector<std::string> scenes;           ///< empty: those of each part
  bool is_quick = false;                     ///< fewer rays, rounds, pixels and large scenes
  std::optional<std::size_t> rounds;         ///< nothing: the part's default
  std::vector<std::uint32_t> thread_counts;  ///< for the part `kernel`, each once, ascending
  std::optional<Resolution> resolution;      ///< nothing: the part's default
  std::filesystem::path program;             ///< dmpc itself, to be run as a separate process
  std::vector<NamedFile> outputs;            ///< none of these may be a file that a scene is read from

  SpeedSettings();  ///< One thread and all cores.

  std::vector<std::string> scenes_of(SpeedPart part) const;
  std::size_t rounds_of(SpeedPart part) const;
  /// Returns a picture with one sample a pixel at depth 5; for paths, 16 samples with three bounces under a white sky.
  PictureOptions picture_of(SpeedPart part, const std::string& scene) const;
  /// Throws as load_scene_beside().
  core::Scene load(const PictureOptions& picture) const;
  /// Returns the part's picture of the scene, ready to be rendered. Throws as load().
  Subject subject_of(SpeedPart part, const std::string& scene) const;
  /// Returns the number of rays of each class in the kernel part.
  std::size_t rays_max() const { return is_quick ? 20'000 : 200'000; }
};

/// Parses "1,2,8" as ascending numbers without repetition, each 1 to 1024. Throws core::UsageError for anything else.
std::vector<std::uint32_t> parse_thread_counts(const std::string& text);

struct Comparison;

/// Measures the part on each of its scenes, in rounds if it is timed. `results` has what is measured so far at any time, also
/// after an exception. Progress goes to stderr if that is a terminal. Throws Interrupted after a signal; core::InputError for an
/// unsuitable scene.
using MeasurePart = void(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Comparison>& results);

/// Times the phase `render` of PlainRenderer on 1 and 2 threads, and of our own renders on many computers, some also as whole
/// commands. Each is compared with the plain renderer on 2 threads. Also compares the numbers of rays, and building times. Leaves
/// out scenes with textures, which it reports on stderr. Also throws core::InputError if the program cannot be run;
/// core::InternalError if our films are not equal or the plain picture is another.
MeasurePart measure_plain;
/// Turns a scene of 1987 into one for a modern path tracer: point lights become emitting spheres with a radius of a twentieth of
/// the diagonal of all objects (core::make_lights_spheres()); mirrors become metals with the same reflectance and microfacets of
/// roughness 0.3. Surfaces that already have microfacets keep them.
void light_and_polish(core::Scene& scene);
/// Times the phase `render` of PlainRenderer, by paths, on 1 and 2 threads, and of our own, replicated on 1 node and by svm on 2,
/// with the same samples and random numbers, so to the same error, and compares the numbers of rays, for each scene as it is, and
/// as light_and_polish() changes it. Leaves out scenes with textures, which it reports on stderr. Throws core::InternalError if
/// our films are not equal or the plain picture differs from ours by more than its noise.
MeasurePart measure_paths;
/// Records each scene's rays and lets all contenders trace them, class by class, as closest and as any hit, on each number of
/// threads, all in every round.
MeasurePart measure_kernel;
/// Times the phase `render` with svm on 8 nodes whose caches hold all pages, or a part of the database. The films are expected to
/// be equal.
MeasurePart measure_emulation;
/// Renders each scene with all skips on, all off and each off by itself, with two cutoffs, and once more with all on, to show the
/// noise, all of them in every round: svm on 2 nodes; for skips that only dataflow has, dataflow on 64. Compares processor time,
/// including the preparation of a skip, and counted operations weighted by their prices (core/trace/work.h), without messages;
/// for a cutoff also the error. Throws core::InternalError if an exact skip changes a film.
MeasurePart measure_ablation;

}  // namespace dmpc::apps
