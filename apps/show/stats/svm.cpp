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

/// What pages and pixels some nodes had to do with.
Json pages_and_work_json(const svm::PageCounters& pages, const svm::WorkCounters& work, bool counted) {
  return {{"pages", pages_json(pages, work.pixels_rendered, counted)}, {"work", work_json(work)}};
}

}  // namespace

StrategyStats strategy_stats(const RenderOptions& options, const svm::Report& report) {
  const svm::Plan& plan = report.plan;
  const bool counted = plan.request.pages.count_pages;
  StrategyStats stats{.options = {{"in_flight", plan.in_flight},
                                  {"work_item", plan.work_item_side},
                                  {"workers", plan.worker_count},
                                  {"count_pages", plan.request.pages.count_pages}},
                      .all = pages_and_work_json(report.pages(), report.work(), counted),
                      .chaos = {{"request_credits", plan.request_credits}, {"film_credits", plan.film_credits}},
                      .host = Json::object()};
  if (options.strategy == Strategy::svm) {
    stats.options["cache_pages"] = plan.frames;
    stats.options["replacement"] = svm::name_of(plan.request.pages.replacement);
  }
  for (const svm::NodeReport& node : report.nodes) {
    stats.nodes.push_back(pages_and_work_json(node.program.pages, node.program.work, counted));
  }
  return stats;
}

}  // namespace dmpc::apps
