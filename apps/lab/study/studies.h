// The studies of one scene: what each is asked for, and what all have.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/frontend/table/plot.h"
#include "apps/lab/study/cache_curves.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/memory_rule.h"
#include "apps/lab/study/runs.h"
#include "apps/run/systems.h"
#include "apps/scene/subject.h"
#include "core/scene/scene.h"
#include "nodes/machine.h"
#include "nodes/topology.h"

namespace dmpc::apps {

/// For each node count the regions by the subsampled picture, cut across the longer side and in alternating directions, those of
/// equal size, one a node and scattered: the average load, predicted and achieved, copies of primitives, and hops of a ray from
/// node to node.
struct BalanceStudy {
  static constexpr const char* name = "balance";
  static constexpr const char* description = "How evenly the work of rays that travel is shared out";

  std::vector<std::uint32_t> node_counts = {4, 8, 16, 32, 64};
  int subsample = 8;  ///< loads are predicted by one pixel of every subsample x subsample
  nodes::TopologyKind topology = nodes::TopologyKind::hypercube;
  bool per_node = false;  ///< below each row one more for each node, with its share of the work

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For each node count one run of dataflow with either balance and one of svm: messages, bytes, average load, memory.
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

/// For each size of the caches the faults of the replacement policies and of the optimum, all for the same references; and, if
/// there is a machine, its time, efficiency and page traffic with lru.
struct CacheStudy {
  static constexpr const char* name = "cache";
  static constexpr const char* description = "How often pages are missed with caches of every size and policy";

  std::uint32_t node_count = 32;           ///< at least 2
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages that are not at home
  std::optional<nodes::Machine> machine;   ///< without it nothing is timed
  std::vector<std::string> policy_places;  ///< of policies that are not dmpc's own
  std::vector<ForeignPolicy> policies;     ///< those, once load() has been called

  /// Loads the policies. Throws as they do.
  void load(const std::function<void()>& check) { policies = load_policies(policy_places, check); }

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For each node count the virtual time on one machine, speedup and efficiency against the first count that the scene fits, and
/// where the nodes' time goes.
struct SpeedupStudy {
  static constexpr const char* name = "speedup";
  static constexpr const char* description = "How much faster a modelled machine gets by more nodes";

  std::vector<std::uint32_t> node_counts = {1, 2, 4, 8, 16, 32, 64};
  /// What all runs have in common, their machine included; its node count is without meaning.
  StrategyOptions run = on_usual_machine();

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  /// Adds to `table`, which has columns(), a row for each node count, those that were finished after a signal; and notes: why a
  /// row is empty (the scene does not fit so many nodes), and what was reduced to fit. Throws as StudyRuns does:
  /// NothingFits when all rows are there, without figures.
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// For pages with caches of several sizes, for questions and for rays that travel, the mean over frames 2 to the last of a
/// camera's path, on modelled machines: each frame by nodes that have rendered those before it (warm), and by others that have
/// rendered none (cold).
struct FramesStudy {
  static constexpr const char* name = "frames";
  static constexpr const char* description = "What frames of a moving camera fetch and send, with caches warm and cold";

  std::vector<std::uint32_t> node_counts = {8};      ///< each at least 2
  std::uint32_t frame_count = 6;                     ///< at least 2
  bool has_each_frame = false;                       ///< rows for single frames, too
  double turntable_degrees = 1;                      ///< a frame
  std::optional<std::filesystem::path> camera_path;  ///< in place of the turntable
  std::vector<nodes::Machine> machines = {*on_usual_machine().computer.machine};
  std::string machine_name = "ipsc2";      ///< of the command line, by which the machines were chosen
  std::vector<std::string> machine_names;  ///< likewise, if there are several
  core::View own_view;                     ///< the scene's, which it is given
  core::Box bounds;                        ///< likewise, in the world's coordinates
  /// The scene and its picture as one tree, of which questions are asked. Must be there to measure().
  std::function<Subject()> build_tree;

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// The structures that systems are compared on, each of which has a table of its own.
enum class SystemStructures : std::uint8_t {
  of_papers,  ///< that which each had when it was described, or the nearest here
  of_today    ///< that which `render --system` gives it
};
/// As the command line calls them: "papers".
const char* name_of(SystemStructures structures);

/// For each of both structures, each number of nodes, each rule of memory and each system a row: whether it fits, its virtual
/// time, where that goes, what travels, and what memory it takes. The article could not make this comparison, since scenes and
/// simulations of the systems that it classifies differ.
struct SystemsStudy {
  static constexpr const char* name = "systems";
  static constexpr const char* description = "The systems that the 1994 article classifies, side by side on one machine";

  /// The scene and its picture in the structure, by the rule for voxels and in pages of the size that are given; the rest of the
  /// options is without meaning.
  using Build = std::function<Subject(const core::BuildOptions&)>;

  std::vector<System> chosen = all_systems();
  std::vector<SystemStructures> structures = {SystemStructures::of_papers, SystemStructures::of_today};
  std::vector<std::uint32_t> node_counts = {64};
  std::vector<MemoryRule> memories = {{}, {.share = 0.25}, {.share = 0.05}, {.share = 0.01}};
  StrategyOptions machine = on_usual_machine();  ///< of the runs, with its runner options; the rest is without meaning
  Build build;                                   ///< must be there to measure()

  static std::vector<System> all_systems();
  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  /// Adds to `table`, which has columns(), the rows; notes: why a system does not fit, and which of the expectations that were
  /// written down before the first of these runs have held. A system that memory does not change has one run for all rules, and
  /// one that has the structure that it had one for both.
  /// Throws as StudyRuns does.
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// Expectations of shared memory against travelling rays and questions, each with what a table of the study says of it: "held",
/// "not held" or, where they differ by 1 % at most, "a tie", with the figures. None where rows are missing.
std::vector<std::string> verdicts_of(const Table& table);

/// One study: its file is all that there is of it. Each has a `name` (the word on the command line) and a `description`;
/// add_options() declares what is its own; columns() are its table's, plots() of such a table; notes() say what the columns mean,
/// and what the 1994 article found if the scene, as on the command line, is one of its own; conclusion() is a sentence or two on
/// a table, computed from its rows, empty if they tell too little. measure() adds row after row to a table that has columns(), as
/// the runs end, and throws as StudyRuns does.
using Study = std::variant<BalanceStudy, TrafficStudy, CacheStudy, SpeedupStudy, SystemsStudy, FramesStudy>;

}  // namespace dmpc::apps
