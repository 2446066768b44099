#include "apps/lab/bench/speed/part.h"

#include <algorithm>
#include <array>
#include <utility>

#include "apps/edge/line/option_values.h"
#include "apps/edge/line/words.h"
#include "apps/edge/system/real_load.h"
#include "apps/lab/study/paper/data.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 10> names = {"plain", "paths", "kernel", "picture", "emulation",
                                               "build", "load",  "memory", "pages",   "ablation"};
/// The others come before it.
constexpr auto comparing_count = static_cast<std::ptrdiff_t>(SpeedPart::ablation);
constexpr std::uint32_t thread_count_max = 1024;
/// A million triangles.
constexpr const char* big_scene = "tetra-10";
constexpr int paths_side = 256, path_samples = 16, path_bounces = 3;
/// A quarter of that, which part plain sets up some thirty times.
constexpr const char* large_scene = "tetra-9";

SpeedPart parse_part(const std::string& word) {
  const auto end = names.begin() + comparing_count, found = std::find(names.begin(), end, word);
  if (found == end) {
    const std::vector<std::string> all(names.begin(), end);
    const std::string meant = core::did_you_mean(word, all);
    throw core::UsageError(
        "--parts=" + word +
        ": expected plain, paths, kernel, picture, emulation, build, load, memory, pages, with commas between" +
        (meant.empty() ? "" : ".") + meant);
  }
  return SpeedPart{static_cast<std::uint8_t>(found - names.begin())};
}

std::vector<std::string> article_scenes() {
  std::vector<std::string> scenes;
  for (const PaperScene& scene : paper_scenes) {
    scenes.emplace_back(scene.scene);
  }
  return scenes;
}

std::vector<std::string> default_scenes(SpeedPart part) {
  switch (part) {
    case SpeedPart::pages:
      return article_scenes();
    case SpeedPart::load:
    case SpeedPart::memory:
      return {"tetra-9", big_scene};
    case SpeedPart::plain:
      return {"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9", "balls-2-t4"};
    case SpeedPart::build:
      return {"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9", big_scene};
    case SpeedPart::ablation:
      return {"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9", "balls-4", "tree-8"};
    default:
      return {"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9"};
  }
}

int default_side(SpeedPart part) {
  if (part == SpeedPart::paths) {
    return paths_side;
  }
  return part == SpeedPart::plain || part == SpeedPart::emulation ? 1024 : static_cast<int>(paper_resolution);
}

}  // namespace

const char* name_of(SpeedPart part) { return names[static_cast<std::size_t>(part)]; }

std::set<SpeedPart> all_speed_parts() {
  std::set<SpeedPart> parts;
  for (std::ptrdiff_t i = 0; i < comparing_count; ++i) {
    parts.insert(SpeedPart{static_cast<std::uint8_t>(i)});
  }
  return parts;
}

std::set<SpeedPart> parse_speed_parts(const std::string& text) {
  std::set<SpeedPart> parts;
  for (const std::string& word : words_between_commas(text, "--parts")) {
    parts.insert(parse_part(word));
  }
  return parts;
}

SpeedSettings::SpeedSettings() : thread_counts{1}, program("/proc/self/exe") {
  if (core_count() > 1) {
    thread_counts.push_back(core_count());
  }
}

std::vector<std::string> SpeedSettings::scenes_of(SpeedPart part) const {
  std::vector<std::string> chosen = scenes.empty() ? default_scenes(part) : scenes;
  if (scenes.empty() && is_quick) {
    std::erase(chosen, big_scene);
    if (part == SpeedPart::plain) {
      std::erase(chosen, large_scene);
    }
  }
  if (part == SpeedPart::pages) {
    const std::vector<std::string> known = article_scenes();
    std::erase_if(chosen, [&](const std::string& scene) { return std::find(known.begin(), known.end(), scene) == known.end(); });
  }
  return chosen;
}

std::size_t SpeedSettings::rounds_of(SpeedPart part) const {
  const std::size_t standard = part == SpeedPart::kernel ? 7 : part == SpeedPart::ablation ? 5 : 3;
  return rounds.value_or(is_quick ? (standard - 1) / 2 : standard);
}

PictureOptions SpeedSettings::picture_of(SpeedPart part, const std::string& scene) const {
  const int side = is_quick ? 128 : default_side(part);
  PictureOptions picture;
  picture.scene = scene;
  picture.resolution = resolution.value_or(Resolution{side, side});
  if (part == SpeedPart::paths) {
    picture.samples = path_samples;
    picture.transport = {.kind = core::TransportKind::paths, .bounces = path_bounces, .sky = SkyChoice{{1, 1, 1}, {}}};
    picture.depth = picture.transport.depth();
    picture.staging.background = picture.transport.sky->horizon;
  }
  return picture;
}

Subject SpeedSettings::subject_of(SpeedPart part, const std::string& scene) const {
  const PictureOptions picture = picture_of(part, scene);
  return build_subject(load(picture), picture);
}

core::Scene SpeedSettings::load(const PictureOptions& picture) const { return load_scene_beside(picture, outputs); }

std::vector<std::uint32_t> parse_thread_counts(const std::string& text) {
  return parse_different_numbers(text, "--threads", thread_count_max);
}

}  // namespace dmpc::apps
