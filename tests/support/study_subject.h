// A small scene to study, and the rows that a study finds.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "apps/interrupt.h"
#include "apps/picture_options.h"
#include "apps/study_runs.h"
#include "apps/study_table.h"
#include "core/database.h"
#include "tests/support/small_scenes.h"

namespace dmpc::tests {

/// A built-in scene, and runs of it.
struct StudySubject {
  explicit StudySubject(const std::string& name, int size = 32)
      : scene(built_in(name)),
        database(core::build_database(scene, {})),
        settings(apps::render_settings({.scene = name, .resolution = apps::Resolution{size, size}}, scene, database)) {}

  template <class Study>
  apps::Table measure(const Study& study) {
    apps::Table table("", study.columns());
    study.measure(runs, table);
    return table;
  }

  core::Scene scene;
  core::Database database;
  core::RenderSettings settings;
  apps::Interrupt interrupt;
  std::ostringstream progress;
  apps::StudyRuns runs{database, settings, {progress, true, 9}, interrupt};
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
