#include "apps/lab/study/systems_plan.h"

#include <tuple>

#include "apps/run/strategy_options.h"
#include "core/database/structure.h"

namespace dmpc::apps {
namespace {

/// Forest's subtrees are its pages; all other systems have pages of one size, so that faults can be compared.
StructureAsked asked_by(System system, SystemStructures structures) {
  const bool is_original = structures == SystemStructures::of_papers;
  const core::BuildOptions build = (is_original ? original_database_of(system) : database_of(system)).build;
  return {build.structure, is_original && build.structure == core::Structure::voxels,
          strategy_of(system).strategy == Strategy::forest ? build.page_size_bytes : 0};
}

constexpr MemoryRule as_needed = {};

/// Adds one node with the whole scene in each structure that is used.
void add_runs_alone(const SystemsStudy& study, SystemPlan& plan) {
  for (const SystemStructures structures : study.structures) {
    for (const System system : study.chosen) {
      const core::Structure structure = asked_by(system, structures).structure;
      const System alone = structure == core::Structure::extents ? System::replicated_extents : System::replicated;
      if (plan.alone.emplace(structure, plan.runs.size()).second) {
        plan.runs.push_back({1, &as_needed, alone, structures});
      }
    }
  }
}

/// Adds a row, with its own run unless an existing one serves it.
class PlannedRows {
 public:
  explicit PlannedRows(SystemPlan& plan) : plan_(plan) {}

  void add(const SystemRun& row) {
    const bool is_bounded = row.memory->changes(row.system);
    const MemoryRule* const memory = is_bounded ? row.memory : &as_needed;
    const auto [place, is_new] = runs_.emplace(std::tuple(row.node_count, memory, row.system, row.asked()), plan_.runs.size());
    if (is_new) {
      plan_.runs.push_back({row.node_count, memory, row.system, row.structures});
    }
    plan_.rows.push_back(row);
    plan_.run_of.push_back(place->second);
  }

 private:
  SystemPlan& plan_;
  std::map<std::tuple<std::uint32_t, const MemoryRule*, System, StructureAsked>, std::size_t> runs_;
};

}  // namespace

std::string text_of(SystemStructures structures) {
  return structures == SystemStructures::of_papers ? "of the papers" : "of today";
}

StructureAsked SystemRun::asked() const { return asked_by(system, structures); }

SystemPlan plan_of(const SystemsStudy& study) {
  SystemPlan plan;
  add_runs_alone(study, plan);
  PlannedRows rows(plan);
  for (const SystemStructures structures : study.structures) {
    for (const std::uint32_t node_count : study.node_counts) {
      for (const MemoryRule& memory : study.memories) {
        for (const System system : study.chosen) {
          rows.add({node_count, &memory, system, structures});
        }
      }
    }
  }
  return plan;
}

Rendered Structures::of(const StructureAsked& asked) {
  if (asked.structure == core::Structure::grid) {
    return usual_;
  }
  auto found = others_.find(asked);
  if (found == others_.end()) {
    core::BuildOptions build;
    build.structure = asked.structure;
    build.page_size_bytes = asked.page_size_bytes == 0 ? usual_.database->page_size() : asked.page_size_bytes;
    build.voxels = asked.is_original ? core::article_voxels : core::usual_voxels;
    found = others_.emplace(asked, build_(build)).first;
  }
  return {&found->second.database, &found->second.settings};
}

}  // namespace dmpc::apps
