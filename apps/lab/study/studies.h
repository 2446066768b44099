// The studies of one scene: the options of each, and their common interface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/frontend/machine/machines.h"
#include "apps/frontend/table/plot.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"
#include "apps/scene/subject.h"
#include "core/scene/scene.h"
#include "nodes/machine.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// For each node count, the regions from the subsampled picture, cut across the longer side and in alternating directions, and
/// those of equal size, one a node and scattered: the average load, predicted and achieved, copies of primitives, and hops of a
/// ray from node to node.
struct BalanceStudy {
  static constexpr const char* name = "balance";
  static constexpr const char* description = "How evenly the work of rays that travel is shared out";

  std::vector<std::uint32_t> node_counts = {4, 8, 16, 32, 64};
  int subsample = 8;  ///< loads are predicted by one pixel of every subsample x subsample
  nodes::TopologyKind topology = nodes::TopologyKind::hypercube;
  bool per_node = false;  ///< adds a row for each node below each row, with the node's share of the work

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For each node count, one run of dataflow with either balance and one of svm: messages, bytes, average load, memory.
struct TrafficStudy {
  static constexpr const char* name = "traffic";
  static constexpr const char* description = "What travels when rays do, beside what travels when pages do";

  std::vector<std::uint32_t> node_counts = {1, 2, 4, 8, 16, 32, 64};

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For each cache size, the faults of the replacement policies and of the optimum, all for the same references; and, if there is
/// a machine, its time, efficiency and page traffic with lru.
struct CacheStudy {
  static constexpr const char* name = "cache";
  static constexpr const char* description = "How often pages are missed with caches of every size and policy";

  std::uint32_t node_count = 32;           ///< at least 2
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages of other nodes
  std::optional<nodes::Machine> machine;   ///< if not given, nothing is timed
  std::vector<std::string> policy_places;  ///< of policies other than dmpc's own
  std::vector<ForeignPolicy> policies;     ///< those policies, after load()

  /// Loads the policies. Throws as they do.
  void load(const std::function<void()>& check) { policies = load_policies(policy_places, check); }

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For pages with caches of several sizes, for questions and for travelling rays, the mean over frames 2 to the last of a
/// camera's path on modelled machines: each frame is rendered by nodes that have rendered the frames before it (warm), and by
/// nodes that have rendered none (cold).
struct FramesStudy {
  static constexpr const char* name = "frames";
  static constexpr const char* description = "What frames of a moving camera fetch and send, with caches warm and cold";

  std::vector<std::uint32_t> node_counts = {8};      ///< each at least 2
  std::uint32_t frame_count = 6;                     ///< at least 2
  bool has_each_frame = false;                       ///< also adds rows for single frames
  double turntable_degrees = 1;                      ///< a frame
  std::optional<std::filesystem::path> camera_path;  ///< replaces the turntable
  std::vector<nodes::Machine> machines = {*on_usual_machine().computer.machine};
  std::string machine_name = "ipsc2";      ///< on the command line, by which the machines were chosen
  std::vector<std::string> machine_names;  ///< likewise, if there are several
  core::View own_view;                     ///< the scene's, set by the caller
  core::Box bounds;                        ///< likewise, in the world's coordinates
  /// Builds the scene and its picture as one tree, to which questions are sent. Required by measure().
  std::function<Subject()> build_tree;

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// One study; its file has all its code. Each has a `name` (the word on the command line) and a `description`. add_options()
/// declares its own options; columns() are its table's, and plots() those of such a table. notes() explain the columns, and quote
/// the 1994 article's result if the scene, as on the command line, is one of its own. conclusion() is a sentence or two computed
/// from a table's rows, empty if there are too few. measure() adds row after row to a table that has columns(), as the runs end,
/// and throws as StudyRuns does.
using Study = std::variant<BalanceStudy, TrafficStudy, CacheStudy, FramesStudy>;

}  // namespace dmpc::apps
