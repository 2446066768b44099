#include "apps/show/stats/strategy.h"

namespace dmpc::apps {

namespace {

Json pages_json(const svm::PageCounters& pages, std::uint64_t pixels, bool counted) {
  const double per_pixel = pixels == 0 ? 0 : static_cast<double>(pages.distinct_pages) / static_cast<double>(pixels);
  return {{"references", pages.references},
          {"hits", pages.home_hits + pages.cache_hits},
          {"home_hits", pages.home_hits},
          {"cache_hits", pages.cache_hits},
          {"misses", pages.misses},
          {"faults", pages.faults},
          {"evictions", pages.evictions},
          {"served", pages.served},
          {"distinct", counted ? Json(pages.distinct_pages) : Json()},
          {"distinct_per_pixel", counted ? Json(per_pixel) : Json()}};
}

Json work_json(const svm::WorkCounters& work) {
  return {{"pixels", work.pixels_rendered},
          {"items_asked", work.items_asked},
          {"items_taken", work.items_taken},
          {"items_given", work.items_given}};
}

Json questions_json(const svm::QuestionCounters& questions) {
  return {{"rays_asked", questions.rays_asked},
          {"records_asked", questions.records_asked},
          {"rays_answered", questions.rays_answered},
          {"records_answered", questions.records_answered},
          {"answers", questions.answers}};
}

/// What pages, pixels and questions some nodes had to do with.
Json shares_json(const svm::PageCounters& pages, const svm::WorkCounters& work, const svm::QuestionCounters& questions,
                 const svm::Plan& plan) {
  Json shares = {{"pages", pages_json(pages, work.pixels_rendered, plan.request.pages.count_pages)}, {"work", work_json(work)}};
  if (plan.request.strategy == svm::Strategy::forest) {
    shares["questions"] = questions_json(questions);
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
