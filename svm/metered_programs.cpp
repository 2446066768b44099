#include "svm/metered_programs.h"

#include <memory>
#include <type_traits>

#include "core/base/expect.h"
#include "svm/local_copy.h"
#include "svm/pager.h"
#include "svm/watch/counting_pager.h"
#include "svm/watch/recording_pager.h"

namespace dmpc::svm {
namespace {

template <class Records>
MakeProgram maker(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                  const RunOptions& options) {
  return [&](std::uint32_t index, nodes::Node& node) -> std::unique_ptr<NodeProgram> {
    const auto make_tracer = [&](Records& records) {
      if constexpr (std::is_same_v<Records, RecordingPager>) {
        records.record_into(options.pages.reference_logs->at(index));
      }
      return core::GridTracer<Records>(records, settings.header, settings.skips);
    };
    return make_metered_program<Records, core::GridTracer<Records>>(node, plan, settings, database.bytes(), make_tracer, options);
  };
}

}  // namespace

MakeProgram metered_programs(const core::Database& database, const core::RenderSettings& settings, const Plan& plan,
                             const RunOptions& options) {
  core::expect(options.watching.is_metered(), "a meter is for somebody");
  if (plan.request.strategy == Strategy::replicated) {
    return maker<LocalCopy>(database, settings, plan, options);
  }
  return plan.request.pages.count_pages            ? maker<CountingPager>(database, settings, plan, options)
         : options.pages.reference_logs != nullptr ? maker<RecordingPager>(database, settings, plan, options)
                                                   : maker<Pager>(database, settings, plan, options);
}

}  // namespace dmpc::svm
