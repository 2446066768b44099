// The runs of the study `systems`, and the subject of each.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/lab/study/memory_rule.h"
#include "apps/lab/study/studies.h"
#include "apps/run/systems.h"
#include "apps/scene/subject.h"
#include "core/database/database.h"
#include "core/database/structure.h"
#include "core/picture/pixel_task.h"

namespace dmpc::apps {

/// Returns "of the papers".
std::string text_of(SystemStructures structures);

/// What a system is rendered from: the deciding properties of structures, rules for voxels and pages.
struct StructureAsked {
  core::Structure structure = core::Structure::grid;
  bool is_original = false;         ///< of voxels: by the article's rule
  std::size_t page_size_bytes = 0;  ///< 0: the study's

  auto operator<=>(const StructureAsked&) const = default;
};

/// A system on a computer: a row of the table, or a run.
struct SystemRun {
  std::uint32_t node_count;
  const MemoryRule* memory;
  System system;
  SystemStructures structures;

  StructureAsked asked() const;
};

/// The runs, the rows, and for each row the index of its run.
struct SystemPlan {
  std::vector<SystemRun> runs, rows;
  std::vector<std::size_t> run_of;
  /// The runs on one node with the whole scene, the base of efficiencies: the first of all.
  std::map<core::Structure, std::size_t> alone;
};
/// Returns the rows, each with the first run that serves it. The study outlives the plan.
SystemPlan plan_of(const SystemsStudy& study);

/// The subject of a system's render.
struct Rendered {
  const core::Database* database;
  const core::RenderSettings* settings;
};

/// The study's scene, and the same scene in other structures that its systems need, each built on first use. Not thread-safe.
/// What it is made from outlives it.
class Structures {
 public:
  Structures(const Rendered& usual, const SystemsStudy::Build& build) : usual_(usual), build_(build) {}

  Rendered of(const StructureAsked& asked);

 private:
  Rendered usual_;
  const SystemsStudy::Build& build_;
  std::map<StructureAsked, Subject> others_;
};

}  // namespace dmpc::apps
