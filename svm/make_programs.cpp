#include "svm/make_programs.h"

#include <type_traits>

#include "core/picture/bundle_task.h"
#include "nodes/watch/meter.h"
#include "svm/forest/forest.h"
#include "svm/local_copy.h"
#include "svm/pages/pager.h"
#include "svm/pages/watch/counting_pager.h"
#include "svm/pages/watch/recording_pager.h"
#include "svm/program.h"

namespace dmpc::svm {
namespace {

/// `log` is there where references are to be noted.
template <class Records>
core::GridTracer<Records> tracer_over(Records& records, const core::RenderSettings& settings,
                                      [[maybe_unused]] ReferenceLog* log) {
  if constexpr (std::is_same_v<Records, RecordingPager>) {
    records.record_into(*log);
  }
  return core::GridTracer<Records>(records, settings.header, settings.skips);
}

template <class Records>
MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                  const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) {
  return [&, reference_logs](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<NodeProgram> {
    ReferenceLog* const log = reference_logs == nullptr ? nullptr : &reference_logs->at(index);
    const auto make_tracer = [&](Records& records) { return tracer_over(records, settings, log); };
    const auto make = [&]<class Task>(std::type_identity<Task>) -> std::unique_ptr<NodeProgram> {
      return std::make_unique<ControlProgram<Records, core::GridTracer<Records>, Task>>(
          node, plan, settings, database, make_tracer, nodes::meter_for(watching, plan.request.computer, node.id()));
    };
    if constexpr (std::is_same_v<Records, Pager> || std::is_same_v<Records, LocalCopy>) {
      if (plan.pixels_a_task > 1) {
        return make(std::type_identity<core::BundleTask>());
      }
    }
    return make(std::type_identity<core::PixelTask>());
  };
}

}  // namespace

MakeProgram maker_of(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                     const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) {
  switch (plan.request.strategy) {
    case Strategy::replicated:
      return maker<LocalCopy>(plan, settings, database, watching, reference_logs);
    case Strategy::forest:
      return maker<Forest>(plan, settings, database, watching, reference_logs);
    case Strategy::svm:
      break;
  }
  return plan.request.pages.count_pages ? maker<CountingPager>(plan, settings, database, watching, reference_logs)
         : reference_logs != nullptr    ? maker<RecordingPager>(plan, settings, database, watching, reference_logs)
                                        : maker<Pager>(plan, settings, database, watching, reference_logs);
}

}  // namespace dmpc::svm
