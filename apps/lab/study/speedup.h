// The study `speedup`: how much faster a modelled machine gets by more nodes, and what becomes of the rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"

namespace dmpc::apps {

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
  /// What the columns mean, and what runs.
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

}  // namespace dmpc::apps
