// What the study `scale` measures: which scenes, on how many nodes, by which method.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "apps/scene/picture_options.h"
#include "core/families/scenes.h"

namespace dmpc::apps {

/// What grows: the scene, or the computer.
enum class ScalePart : std::uint8_t { sizes, nodes };
/// As the command line and the table call it.
const char* name_of(ScalePart part);

/// Who renders: svm with a cache of so many bytes on each node, svm with the cache that `render` gives it by default (a quarter
/// of the database, at least 64 pages), or dataflow.
enum class ScaleMethod : std::uint8_t { cache, quarter, dataflow };

struct ScaleSettings {
  static constexpr std::size_t page_bytes = 1024;  ///< of all runs

  std::vector<std::string> families = {"tetra", "mount"};  ///< of built-in scenes
  std::vector<int> sizes;                                  ///< of each family; empty: its standard_sizes()
  std::set<ScalePart> parts = {ScalePart::sizes, ScalePart::nodes};
  std::vector<ScaleMethod> methods = {ScaleMethod::cache, ScaleMethod::quarter, ScaleMethod::dataflow};
  std::uint32_t node_count = 8;                                                 ///< of part sizes
  std::vector<std::uint32_t> node_counts = {1, 2, 4, 8, 16, 32, 64, 128, 256};  ///< of part nodes
  std::optional<std::string> nodes_scene;                                       ///< of part nodes; nothing: scene_of_nodes()
  std::size_t cache_bytes = std::size_t{1} << 20U;                              ///< a node's, of method cache
  Resolution resolution{512, 512};
  std::uint32_t rounds = 1;  ///< everything is run so often, and medians are taken
  std::filesystem::path program = "/proc/self/exe";

  /// The scenes of a family, in order. Throws core::InputError for what is no family, or has no such size.
  std::vector<core::SceneName> scenes_of(const std::string& family) const;
  /// The scene of part nodes: the middle one of the first family if none is given. Throws core::InputError if there is no such
  /// built-in scene.
  core::SceneName scene_of_nodes() const;
  /// How the table calls it: "svm 1MiB", "svm quarter", "dataflow".
  std::string name_of(ScaleMethod method) const;
};

/// One computer that renders one scene.
struct ScaleRun {
  ScalePart part = ScalePart::sizes;
  core::SceneName scene;
  ScaleMethod method = ScaleMethod::cache;
  std::uint32_t node_count = 1;
};

/// All runs, in the order of the table: from small to large, and all methods with one scene and one number of nodes before the
/// next, so that what else the real computer does troubles all alike. A quarter of the database on every one of many nodes is
/// more than it has: part nodes leaves that method out. Throws as scenes_of() and scene_of_nodes().
std::vector<ScaleRun> scale_runs(const ScaleSettings& settings);

/// The sizes of a family from a thousand primitives to the most that there are, each with at least twice as many as the one
/// before; 1 if none has a thousand. Throws core::InputError for what is no family.
std::vector<int> standard_sizes(const std::string& family);

/// "5-9", "4,6,8-10" as sizes in order, without repetition. Throws core::UsageError for anything else.
std::vector<int> parse_scale_sizes(const std::string& text);
/// "sizes,nodes". Throws core::UsageError for other words, or one that is there twice.
std::set<ScalePart> parse_scale_parts(const std::string& text);
/// "cache,quarter,dataflow". Likewise.
std::vector<ScaleMethod> parse_scale_methods(const std::string& text);

}  // namespace dmpc::apps
