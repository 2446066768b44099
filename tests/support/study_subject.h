// A small scene to study, and the rows that a study finds.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "apps/interrupt.h"
#include "apps/study_runs.h"
#include "apps/study_table.h"
#include "apps/subject.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests {

/// A built-in scene, and runs of it.
struct StudySubject {
  explicit StudySubject(const std::string& name, int size = 32)
      : subject(apps::build_subject(built_in(name), {.scene = name, .resolution = apps::Resolution{size, size}})) {}

  template <class Study>
  apps::Table measure(const Study& study) {
    apps::Table table("", study.columns());
    study.measure(runs, table);
    return table;
  }

  apps::Subject subject;
  apps::Interrupt interrupt;
  std::ostringstream progress;
  apps::StudyRuns runs{subject.database, subject.settings, {progress, true, 9}, interrupt};
};

/// What stands in the column called `name` of `row`.
inline apps::Cell cell(const apps::Table& table, std::size_t row, const std::string& name) {
  std::size_t column = 0;
  while (table.columns().at(column).name != name) {
    ++column;
  }
  return table.rows().at(row)[column];
}

/// The same where a real number, a whole one or nothing is known to stand.
inline double real(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::get<double>(cell(table, row, name));
}
inline std::uint64_t whole(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::get<std::uint64_t>(cell(table, row, name));
}
inline bool is_missing(const apps::Table& table, std::size_t row, const std::string& name) {
  return std::holds_alternative<std::monostate>(cell(table, row, name));
}

}  // namespace dmpc::tests
