// Settings of the study `scale`: the scenes, the numbers of nodes and the methods.
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
const char* name_of(ScalePart part);

/// The method of rendering: svm with a cache of a given size on each node, svm with the default cache of `render` (a quarter of
/// the database, at least 64 pages), or dataflow.
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
  std::uint32_t rounds = 1;  ///< each run is repeated this often, and medians are taken
  std::filesystem::path program = "/proc/self/exe";

  /// Returns the scenes of a family, in order. Throws core::InputError if the family or a size is unknown.
  std::vector<core::SceneName> scenes_of(const std::string& family) const;
  /// Returns the scene of part nodes: the middle one of the first family if none is given. Throws core::InputError if there is no
  /// such built-in scene.
  core::SceneName scene_of_nodes() const;
  /// Returns the name in the table: "svm 1MiB", "svm quarter", "dataflow".
  std::string name_of(ScaleMethod method) const;
};

/// One computer that renders one scene.
struct ScaleRun {
  ScalePart part = ScalePart::sizes;
  core::SceneName scene;
  ScaleMethod method = ScaleMethod::cache;
  std::uint32_t node_count = 1;
};

/// Returns all runs in the order of the table: from small to large, and all methods with one scene and one number of nodes before
/// the next, so that other load on the real computer affects all alike. Part nodes leaves out the method with a quarter of the
/// database on each node, since many nodes need more memory than the computer has. Throws as scenes_of() and scene_of_nodes().
std::vector<ScaleRun> scale_runs(const ScaleSettings& settings);

/// Returns the sizes of a family from a thousand primitives to the largest, each with at least twice as many as the one before; 1
/// if none has a thousand. Throws core::InputError for an unknown family.
std::vector<int> standard_sizes(const std::string& family);

/// Parses "5-9", "4,6,8-10" into sizes in order, without repetition. Throws core::UsageError for anything else.
std::vector<int> parse_scale_sizes(const std::string& text);
/// Parses "sizes,nodes". Throws core::UsageError for other or repeated words.
std::set<ScalePart> parse_scale_parts(const std::string& text);
/// Parses "cache,quarter,dataflow" likewise.
std::vector<ScaleMethod> parse_scale_methods(const std::string& text);

}  // namespace dmpc::apps
