#include "apps/frontend/show/stats/counters_json.h"
#include "apps/show/counters.h"
#include "apps/show/stats/strategy.h"
#include "svm/forest/strategy.h"

namespace dmpc::apps {

namespace {

Json pages_json(const svm::PageCounters& pages, std::uint64_t pixels, bool counted) {
  Json all = json_of(pages);
  const double per_pixel = pixels == 0 ? 0 : static_cast<double>(pages.distinct_pages) / static_cast<double>(pixels);
  all["distinct_per_pixel"] = per_pixel;
  if (!counted) {
    all["distinct"] = all["distinct_per_pixel"] = nullptr;
  }
  return all;
}

/// Returns the pages, pixels and questions of some nodes.
Json shares_json(const svm::PageCounters& pages, const svm::WorkCounters& work, const svm::QuestionCounters& questions,
                 const svm::Plan& plan) {
  Json shares = {{"pages", pages_json(pages, work.pixels_rendered, plan.request.pages.count_pages)}, {"work", json_of(work)}};
  if (plan.request.strategy == svm::forest_strategy()) {
    shares["questions"] = json_of(questions);
  }
  return shares;
}

}  // namespace

StrategyStats strategy_stats(const RenderOptions& options, const svm::Report& report) {
  const svm::Plan& plan = report.plan;
  StrategyStats stats{.all = shares_json(report.pages(), report.work(), report.questions(), plan),
                      .chaos = {{"request_credits", plan.request_credits}, {"film_credits", plan.film_credits}},
                      .host = Json::object()};
  if (options.strategy == Strategy::svm) {
    stats.host["pages_served"] = report.host_pages_served;
  }
  for (const svm::NodeReport& node : report.nodes) {
    stats.nodes.push_back(shares_json(node.program.pages, node.program.work, node.program.questions, plan));
  }
  return stats;
}

}  // namespace dmpc::apps
