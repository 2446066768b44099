// Makes the node programs of a plan over one kind of records, with our own grid.
#pragma once

#include <cstdint>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/picture/bundle_task.h"
#include "core/picture/pixel_task.h"
#include "core/trace/traversal.h"
#include "nodes/byte_source.h"
#include "nodes/node.h"
#include "nodes/observers/meter.h"
#include "nodes/observers/watching.h"
#include "svm/pages/observers/observed_pagers.h"
#include "svm/plan.h"
#include "svm/program.h"
#include "svm/strategy.h"

namespace dmpc::svm {

/// `log` is set if references are to be recorded.
template <class Records>
core::GridTracer<Records> tracer_over(Records& records, const core::RenderSettings& settings,
                                      [[maybe_unused]] ReferenceLog* log) {
  if constexpr (std::is_same_v<Records, RecordingPager>) {
    records.record_into(*log);
  }
  return core::GridTracer<Records>(records, settings.header, settings.skips);
}

/// `reference_logs`, one per node, are set if references are to be recorded. `Bundles`: whether programs of bundles are made
/// where the plan has them. All arguments outlive the result and its calls; `database`, unless nodes refer to it, and the plan's
/// resident pages may end once all programs are made.
template <class Records, bool Bundles = false>
MakeProgram maker_over(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                       const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) {
  return [&, reference_logs](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<NodeProgram> {
    ReferenceLog* const log = reference_logs == nullptr ? nullptr : &reference_logs->at(index);
    const auto make_tracer = [&](Records& records) { return tracer_over(records, settings, log); };
    const auto make = [&]<class Task>(std::type_identity<Task>) -> std::unique_ptr<NodeProgram> {
      return std::make_unique<ControlProgram<Records, core::GridTracer<Records>, Task>>(
          node, plan, settings, database, make_tracer, nodes::meter_for(watching, plan.request.computer, node.id()));
    };
    if constexpr (Bundles) {
      if (plan.pixels_a_task > 1) {
        return settings.header.has_instances != 0 ? make(std::type_identity<core::InstanceBundleTask>())
                                                  : make(std::type_identity<core::BundleTask>());
      }
    }
    return settings.header.has_instances != 0 ? make(std::type_identity<core::InstancePixelTask>())
                                              : make(std::type_identity<core::PixelTask>());
  };
}

}  // namespace dmpc::svm
