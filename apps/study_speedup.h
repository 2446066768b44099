// The study `speedup`: how much faster a modelled machine gets by more nodes, and what becomes of the rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/machines.h"
#include "apps/study_runs.h"
#include "apps/study_table.h"
#include "apps/time_parts.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// What travels in the study.
enum class SpeedupStrategy : std::uint8_t { svm, dataflow };

/// For each node count the virtual time on one machine, speedup and efficiency against the first count, and where the nodes' time
/// goes.
struct SpeedupStudy {
  static constexpr const char* name = "speedup";
  static constexpr const char* description = "How much faster a modelled machine gets by more nodes";

  std::vector<std::uint32_t> node_counts = {1, 2, 4, 8, 16, 32, 64};
  SpeedupStrategy strategy = SpeedupStrategy::svm;
  nodes::Machine machine = find_machine_preset("ipsc2")->machine;

  std::vector<Column> columns() const;
  /// How many times measure() renders.
  std::uint32_t run_count() const { return static_cast<std::uint32_t>(node_counts.size()); }
  /// Adds to `table`, which has columns(), row after row as the runs end. Throws as StudyRuns::run() does.
  void measure(StudyRuns& runs, Table& table) const;
  /// What the columns mean.
  std::vector<std::string> notes(const std::string& scene) const;
};

}  // namespace dmpc::apps
