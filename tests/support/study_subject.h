// A small scene to study, and the rows that a study finds.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/runs.h"
#include "apps/scene/subject.h"
#include "tests/support/small_scenes.h"
#include "tests/support/table_cells.h"

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
  apps::StudyRuns runs{subject.database, subject.settings, {progress, true}, interrupt};
};

}  // namespace dmpc::tests
