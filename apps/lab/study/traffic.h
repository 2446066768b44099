// The study `traffic`: what travels when rays do, beside what travels when pages do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/runs.h"

namespace dmpc::apps {

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

}  // namespace dmpc::apps
