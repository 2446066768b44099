#include "svm/forest/strategy.h"

#include <algorithm>
#include <utility>

#include "core/base/expect.h"
#include "core/database/database.h"
#include "svm/forest/forest.h"
#include "svm/program_maker.h"
#include "svm/run.h"

namespace dmpc::svm {

namespace {

/// The approximate memory for packets of questions that a node keeps.
constexpr std::size_t question_room_wanted_bytes = std::size_t{64} << 10U;
constexpr std::uint32_t question_credits_max = 4;

void check_conservation_at(const NodeReport& node) {
  const QuestionCounters& questions = node.program.questions;
  const nodes::TrafficByKind &sent = node.counters.sent, &received = node.counters.received;
  const auto packets_of = [](const nodes::TrafficByKind& traffic, Kind kind) { return traffic[number_of(kind)].packets; };
  core::expect(questions.rays_asked + questions.records_asked == questions.answers, "every question was answered, once");
  core::expect(packets_of(sent, Kind::questions) == packets_of(received, Kind::answers) &&
                   packets_of(received, Kind::questions) == packets_of(sent, Kind::answers),
               "every packet of questions was answered by one");
}

class ForestStrategy final : public Strategy {
 public:
  const char* name() const override { return "forest"; }
  /// In a base mesh a question names the instance that one ray is in.
  bool takes_bundles(bool has_instances) const override { return !has_instances; }

  void check(const PlanRequest& request) const override {
    core::check_use(
        request.forest_page_count > 0, core::field_of<&PlanRequest::strategy>(),
        "=forest needs one tree of boxes whose subtrees lie in pages: ", core::field_of<&core::BuildOptions::structure>(),
        "=extents and ", core::field_of<&core::BuildOptions::record_order>(), "=spatial");
  }
  std::uint32_t usual_tasks(const PlanRequest& request) const override {
    if (request.computer.machine) {
      return modelled_in_flight;
    }
    const std::uint64_t workers = std::max(request.worker_count(), 1U);
    const std::uint64_t quarter = std::uint64_t{request.width} * request.height / (4 * workers);
    const auto pixels = std::clamp<std::uint64_t>(quarter, forest_in_flight_least, forest_in_flight_most);
    return static_cast<std::uint32_t>(pixels / (request.bundles ? bundle_pixels : 1));
  }
  std::uint32_t leading_pages(const PlanRequest& request) const override {
    const bool are_held = holds_open_pages(request.open_page_count, request.page_size_bytes);
    return request.forest_page_count + (are_held ? request.open_page_count : 0);
  }

  /// Packets of questions: no more than pixels, each of which asks one question at a time.
  std::uint32_t request_credits(const Plan& plan) const override {
    const std::uint32_t others = plan.request.computer.node_count - 1;
    if (others == 0) {
      return 0;
    }
    const std::size_t packet_bytes = question_packet_bytes(plan.pages());
    const auto wanted = static_cast<std::uint32_t>(question_room_wanted_bytes / (packet_bytes * others));
    return std::min(plan.in_flight, std::clamp(wanted, 1U, question_credits_max));
  }

  /// The packets may be small or bulk.
  void add_slots(const Plan& plan, nodes::MailboxCapacity& capacity) const override {
    const std::uint32_t others = plan.request.computer.node_count - 1;
    const std::uint32_t asked = others * plan.request_credits;      // questions: each other node's credits for this one
    const std::uint32_t answers = std::min(plan.in_flight, asked);  // one for each packet of questions
    capacity.small_slots += asked + answers;
    capacity.bulk_slots += asked + answers;
    capacity.bulk_payload_bytes = std::max(capacity.bulk_payload_bytes, question_packet_bytes(plan.pages()));
  }

  nodes::MemoryPlan layout(const Plan& plan, std::uint32_t index) const override { return Forest::layout(plan.pages(), index); }

  void for_each_piece(const Plan& plan, std::uint32_t index, const Visit& visit) const override {
    const PageCapacity pages = plan.pages();
    visit(0, pages.leading_bytes());
    HomePages::for_each_page(pages, index, [&](std::size_t offset) { visit(offset, pages.page_size_bytes()); });
  }

  MakeProgram maker(const Plan& plan, const core::RenderSettings& settings, const nodes::ByteSource& database,
                    const nodes::Watching& watching, std::vector<ReferenceLog>* reference_logs) const override {
    return maker_over<Forest, true>(plan, settings, database, watching, reference_logs);
  }

  void check_conservation(const Report& report) const override {
    std::for_each(report.nodes.begin(), report.nodes.end(), check_conservation_at);
    const QuestionCounters questions = report.questions();
    core::expect(questions.rays_asked == questions.rays_answered && questions.records_asked == questions.records_answered,
                 "every question was answered by somebody");
  }
};

}  // namespace

const Strategy* forest_strategy() {
  static const ForestStrategy strategy;
  return &strategy;
}

Report run_forest(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                  std::stop_token stop) {
  return run_by(*forest_strategy(), database, settings, options, std::move(stop));
}

}  // namespace dmpc::svm
