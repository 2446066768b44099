#include "apps/lab/study/scale/settings.h"

#include <algorithm>
#include <string_view>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace {

const std::vector<std::string> part_names = {"sizes", "nodes"}, method_names = {"cache", "quarter", "dataflow"};

/// The number of primitives in the smallest scene of a family.
constexpr std::uint64_t least_count = 1000;
constexpr int size_limit = 100'000;

/// Returns the meanings of the words of `text`, each by its index in `names`. Throws core::UsageError.
template <class Meaning>
std::vector<Meaning> meanings_of(const std::string& text, const std::string& option, const std::vector<std::string>& names) {
  std::vector<Meaning> meanings;
  for (const std::string& word : words_between_commas(text, option)) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      throw core::UsageError(option + "=" + word + ": expected " + joined(names, ", ") + ", with commas between");
    }
    const Meaning meaning{static_cast<std::uint8_t>(found - names.begin())};
    if (std::find(meanings.begin(), meanings.end(), meaning) != meanings.end()) {
      throw core::UsageError(option + "=" + text + ": " + word + " is there twice");
    }
    meanings.push_back(meaning);
  }
  return meanings;
}

bool exists(const core::SceneName& scene) {
  try {
    core::check_scene_name(scene);
    return true;
  } catch (const core::InputError&) {
    return false;
  }
}

}  // namespace

const char* name_of(ScalePart part) { return part_names[static_cast<std::size_t>(part)].c_str(); }

std::vector<core::SceneName> ScaleSettings::scenes_of(const std::string& family) const {
  std::vector<core::SceneName> scenes;
  for (const int size : sizes.empty() ? standard_sizes(family) : sizes) {
    scenes.push_back({.family = family, .size = size});
    core::check_scene_name(scenes.back());
  }
  return scenes;
}

core::SceneName ScaleSettings::scene_of_nodes() const {
  if (nodes_scene) {
    return core::parse_scene_name(*nodes_scene);
  }
  const std::vector<core::SceneName> scenes = scenes_of(families.front());
  return scenes[scenes.size() / 2];
}

std::string ScaleSettings::name_of(ScaleMethod method) const {
  return method == ScaleMethod::cache ? "svm " + nodes::size_text(cache_bytes)
                                      : std::string(method == ScaleMethod::quarter ? "svm quarter" : "dataflow");
}

std::vector<ScaleRun> scale_runs(const ScaleSettings& settings) {
  std::vector<ScaleRun> runs;
  const auto add = [&](const ScaleRun& run) {
    if (settings.parts.contains(run.part)) {
      runs.push_back(run);
    }
  };
  for (const std::string& family : settings.families) {
    for (const core::SceneName& scene : settings.scenes_of(family)) {
      for (const ScaleMethod method : settings.methods) {
        add({ScalePart::sizes, scene, method, settings.node_count});
      }
    }
  }
  const core::SceneName scene = settings.scene_of_nodes();
  for (const std::uint32_t node_count : settings.node_counts) {
    for (const ScaleMethod method : settings.methods) {
      if (method != ScaleMethod::quarter) {
        add({ScalePart::nodes, scene, method, node_count});
      }
    }
  }
  return runs;
}

std::vector<int> standard_sizes(const std::string& family) {
  std::vector<int> sizes;
  std::uint64_t wanted = least_count;
  for (int size = 1; exists({.family = family, .size = size}); ++size) {
    const std::uint64_t count = core::primitive_count({.family = family, .size = size});
    if (count >= wanted) {
      sizes.push_back(size);
      wanted = 2 * count;
    }
  }
  if (sizes.empty()) {
    core::check_scene_name({.family = family, .size = 1});  // throws if there is no such family
    sizes.push_back(1);
  }
  return sizes;
}

std::vector<int> parse_scale_sizes(const std::string& text) {
  std::set<int> sizes;
  for (const std::string& word : words_between_commas(text, "--sizes")) {
    const std::string_view range = word;
    const std::size_t dash = std::min(range.find('-'), range.size());
    const auto first = number_in<int>(range.substr(0, dash));
    const auto last = dash == range.size() ? first : number_in<int>(range.substr(dash + 1));
    if (!first || !last || *first < 1 || *last < *first || *last > size_limit) {
      throw core::UsageError("--sizes=" + text + ": expected sizes of scenes such as 5-9 or 4,6,8");
    }
    for (int size = *first; size <= *last; ++size) {
      sizes.insert(size);
    }
  }
  return {sizes.begin(), sizes.end()};
}

std::set<ScalePart> parse_scale_parts(const std::string& text) {
  const auto parts = meanings_of<ScalePart>(text, "--parts", part_names);
  return {parts.begin(), parts.end()};
}

std::vector<ScaleMethod> parse_scale_methods(const std::string& text) {
  return meanings_of<ScaleMethod>(text, "--methods", method_names);
}

}  // namespace dmpc::apps
