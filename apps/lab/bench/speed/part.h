// The parts of `bench speed`, and what is chosen for all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/edge/system/distinct_files.h"
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
/// Those that compare speeds: all but ablation, which is asked for by itself.
std::set<SpeedPart> all_speed_parts();
/// "kernel,plain". Throws core::UsageError for anything that is none, listing those that there are.
std::set<SpeedPart> parse_speed_parts(const std::string& text);

struct SpeedSettings {
  std::vector<std::string> scenes;           ///< none: those of each part
  bool is_quick = false;                     ///< fewer rays, rounds, pixels and large scenes
  std::optional<std::size_t> rounds;         ///< nothing: what the part takes
  std::vector<std::uint32_t> thread_counts;  ///< of kernel, each once, ascending
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

}  // namespace dmpc::apps
