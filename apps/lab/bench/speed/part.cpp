#include "apps/lab/bench/speed/part.h"

#include <array>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/unknown_option.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/system/real_load.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/nearest_word.h"

namespace dmpc::apps {
namespace {

/// A quarter of a million triangles; part plain sets it up some thirty times.
constexpr const char* large_scene = "tetra-9";
/// Many parts have these.
const std::vector<std::string> usual_scenes = {"teapot-12", "mount-6-t6", "rings-4-t1", large_scene};

struct PartDefaults {
  const char* name;
  std::vector<std::string> scenes = usual_scenes;
  int side = 512;  ///< pixels a side of its pictures
  std::size_t rounds = 3;
};

/// By index.
const std::array<PartDefaults, speed_part_count>& all_defaults() {
  static const std::array<PartDefaults, speed_part_count> all = {
      {{.name = "plain",
        .scenes = {"teapot-12", "mount-6-t6", "rings-4-t1", large_scene, "balls-2-t4", "jacks-3", "lattice-12"},
        .side = 1024},
       {.name = "paths", .side = 256},
       {.name = "kernel", .rounds = 7},
       {.name = "emulation", .side = 1024},
       {.name = "ablation", .scenes = {"teapot-12", "mount-6-t6", "rings-4-t1", "tetra-9", "balls-4", "tree-8"}, .rounds = 5}}};
  return all;
}
const PartDefaults& defaults_of(SpeedPart part) { return all_defaults()[static_cast<std::size_t>(part)]; }

constexpr std::uint32_t thread_count_max = 1024;
constexpr int path_samples = 16, path_bounces = 3;

SpeedPart parse_part(const std::string& word) {
  std::vector<std::string> names;
  std::string list;
  for (const SpeedPart part : all_speed_parts()) {
    if (word == name_of(part)) {
      return part;
    }
    names.emplace_back(name_of(part));
    list += names.back() + ", ";
  }
  if (const std::string instead = said_instead_of("--parts=" + word); !instead.empty()) {
    throw core::UsageError("--parts=" + word + " is no longer a part: " + instead);
  }
  const std::string meant = core::did_you_mean(word, names);
  throw core::UsageError("--parts=" + word + ": expected " + list + "with commas between" + (meant.empty() ? "" : ".") + meant);
}

}  // namespace

const char* name_of(SpeedPart part) { return defaults_of(part).name; }

std::set<SpeedPart> all_speed_parts() {
  std::set<SpeedPart> parts;
  for (std::uint8_t i = 0; SpeedPart{i} != SpeedPart::ablation; ++i) {
    parts.insert(SpeedPart{i});
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
  std::vector<std::string> chosen = scenes.empty() ? defaults_of(part).scenes : scenes;
  if (scenes.empty() && is_quick && part == SpeedPart::plain) {
    std::erase(chosen, large_scene);
  }
  return chosen;
}

std::size_t SpeedSettings::rounds_of(SpeedPart part) const {
  const std::size_t standard = defaults_of(part).rounds;
  return rounds.value_or(is_quick ? (standard - 1) / 2 : standard);
}

PictureOptions SpeedSettings::picture_of(SpeedPart part, const std::string& scene) const {
  const int side = is_quick ? 128 : defaults_of(part).side;
  PictureOptions picture;
  picture.scene = scene;
  picture.resolution = resolution.value_or(Resolution{side, side});
  if (part == SpeedPart::paths) {
    picture.samples = path_samples;
    picture.transport = {.kind = core::TransportKind::paths, .bounces = path_bounces, .sky = SkyChoice{{1, 1, 1}, {}}};
    picture.depth = picture.transport.depth();
    picture.scene_setup.background = picture.transport.sky->horizon;
  }
  return picture;
}

Subject SpeedSettings::subject_of(SpeedPart part, const std::string& scene) const {
  PictureOptions picture = picture_of(part, scene);
  take_scene(picture, scene);
  return build_subject(load(picture), picture);
}

core::Scene SpeedSettings::load(const PictureOptions& picture) const { return load_scene_beside(picture, outputs); }

std::vector<std::uint32_t> parse_thread_counts(const std::string& text) {
  return parse_different_numbers(text, "--threads", thread_count_max);
}

}  // namespace dmpc::apps
