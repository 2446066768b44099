// The study `systems`: the systems of the article's Table 1 on one machine, with the same scene, picture and counters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/memory_rule.h"
#include "apps/lab/study/runs.h"
#include "apps/run/systems.h"
#include "apps/scene/subject.h"
#include "core/database/database.h"

namespace dmpc::apps {

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
  /// What the columns mean, and what runs.
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// Expectations of shared memory against travelling rays and questions, each with what a table of the study says of it: "held",
/// "not held" or, where they differ by 1 % at most, "a tie", with the figures. None where rows are missing.
std::vector<std::string> verdicts_of(const Table& table);

}  // namespace dmpc::apps
