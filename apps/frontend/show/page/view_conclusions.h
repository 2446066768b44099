// What was seen of a run beyond its counters, in a sentence or two for each section of its page, empty where there is nothing to
// say.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/frontend/run/run_view.h"
#include "svm/pages/pager.h"

namespace dmpc::apps::html {

/// Names the largest of the waits, too, if they have names.
std::string time_conclusion(const nodes::ActivitySteps& steps, std::span<const std::string> wait_names = {});
std::string page_conclusion(const svm::PageCounters& pages, const svm::Fetches& fetches);
std::string fetch_conclusion(const svm::Fetches& fetches);
std::string cache_conclusion(const MissEstimate& misses, std::uint32_t cache_pages, std::uint32_t page_count);

}  // namespace dmpc::apps::html
