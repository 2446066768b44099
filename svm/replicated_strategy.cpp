// Every node holds the whole database.
#include "core/base/refusal.h"
#include "svm/local_copy.h"
#include "svm/program_maker.h"
#include "svm/strategy.h"

namespace dmpc::svm {
namespace {

class ReplicatedStrategy final : public Strategy {
 public:
  const char* name() const override { return "replicated"; }
  /// No task ever waits.
  std::uint32_t usual_tasks(const PlanRequest& /*request*/) const override { return 1; }
  core::Sentence advice() const override {
    constexpr core::Field strategy = core::field_of<&PlanRequest::strategy>();
    return core::Sentence("; every node of ", strategy, "=replicated holds the whole database, ", strategy, "=svm spreads it");
  }
  nodes::MemoryPlan layout(const Plan& plan, std::uint32_t /*index*/) const override {
    return LocalCopy::layout(plan.pages().database_bytes());
  }
  void for_each_piece(const Plan& plan, std::uint32_t /*index*/, const Visit& visit) const override {
    visit(0, plan.pages().database_bytes());
  }
  MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                    const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) const override {
    return maker_over<LocalCopy, true>(plan, settings, database, watching, reference_logs);
  }
};

}  // namespace

const Strategy* replicated_strategy() {
  static const ReplicatedStrategy strategy;
  return &strategy;
}

}  // namespace dmpc::svm
