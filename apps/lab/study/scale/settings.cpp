#include "apps/lab/study/scale/settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "apps/edge/line/words.h"
#include "core/base/expect.h"
#include "nodes/size_text.h"

namespace dmpc::apps {
namespace {

constexpr std::array<const char*, 2> part_names = {"sizes", "nodes"};
constexpr std::array<const char*, 3> method_names = {"cache", "quarter", "dataflow"};

/// The number of primitives in the smallest scene of a family.
constexpr std::uint64_t least_count = 1000;
constexpr int size_limit = 100'000;

/// Where `word` stands among `names`. Throws core::UsageError.
template <std::size_t count>
std::size_t index_of(const std::string& word, const std::array<const char*, count>& names, const std::string& option) {
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) {
    throw core::UsageError(option + "=" + word + ": expected " + joined({names.begin(), names.end()}, ", ") +
                           ", with commas between");
  }
  return static_cast<std::size_t>(found - names.begin());
}

[[noreturn]] void fail_on_sizes(const std::string& text) {
  throw core::UsageError("--sizes=" + text + ": expected sizes of scenes such as 5-9 or 4,6,8");
}

/// Reads a size from the front of `text`.
int take_size(std::string_view& text, const std::string& all) {
  int size = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, size);
  if (error != std::errc() || size < 1 || size > size_limit) {
    fail_on_sizes(all);
  }
  text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
  return size;
}

/// "5" or "5-9".
std::pair<int, int> parse_range(const std::string& word, const std::string& all) {
  std::string_view text = word;
  const int first = take_size(text, all);
  if (text.empty()) {
    return {first, first};
  }
  if (text.front() != '-') {
    fail_on_sizes(all);
  }
  text.remove_prefix(1);
  const int last = take_size(text, all);
  if (!text.empty() || last < first) {
    fail_on_sizes(all);
  }
  return {first, last};
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

const char* name_of(ScalePart part) { return part_names[static_cast<std::size_t>(part)]; }

ScaleSettings::ScaleSettings() : program("/proc/self/exe") {}

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
    const auto [first, last] = parse_range(word, text);
    for (int size = first; size <= last; ++size) {
      sizes.insert(size);
    }
  }
  return {sizes.begin(), sizes.end()};
}

std::set<ScalePart> parse_scale_parts(const std::string& text) {
  std::set<ScalePart> parts;
  for (const std::string& word : words_between_commas(text, "--parts")) {
    parts.insert(ScalePart{static_cast<std::uint8_t>(index_of(word, part_names, "--parts"))});
  }
  return parts;
}

std::vector<ScaleMethod> parse_scale_methods(const std::string& text) {
  std::vector<ScaleMethod> methods;
  for (const std::string& word : words_between_commas(text, "--methods")) {
    const ScaleMethod method{static_cast<std::uint8_t>(index_of(word, method_names, "--methods"))};
    if (std::find(methods.begin(), methods.end(), method) != methods.end()) {
      throw core::UsageError("--methods=" + text + ": " + word + " is there twice");
    }
    methods.push_back(method);
  }
  return methods;
}

}  // namespace dmpc::apps
