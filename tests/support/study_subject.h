// A small scene to study, and the rows that a study finds.
#pragma once

#include <string>

#include "apps/frontend/system/interrupt.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/study/cache.h"
#include "apps/scene/subject.h"
#include "tests/support/small_scenes.h"
#include "tests/support/table_cells.h"

namespace dmpc::tests {

/// A built-in scene, and runs of it.
struct StudySubject {
  explicit StudySubject(const std::string& name, int size = 32)
      : subject(apps::build_subject(built_in(name), {.scene = name, .resolution = apps::Resolution{size, size}})) {}

  apps::Table measure(const apps::CacheStudy& study) {
    apps::Table table("", study.columns());
    study.measure(runs, table);
    return table;
  }

  apps::Subject subject;
  apps::Interrupt interrupt;
  apps::CacheRuns runs{subject.database, subject.settings, interrupt};
};

}  // namespace dmpc::tests
