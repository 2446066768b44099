// Conclusions from a run's recorded data beyond its counters: a sentence or two for each section of its page, or nothing.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/frontend/run/run_view.h"
#include "svm/pages/node_program.h"

namespace dmpc::apps::html {

/// Names the largest wait, too, if waits have names.
std::string time_conclusion(const nodes::ActivitySteps& steps, std::span<const std::string> wait_names = {});
std::string page_conclusion(const svm::PageCounters& pages, const svm::Fetches& fetches);
std::string fetch_conclusion(const svm::Fetches& fetches);
/// What twice the cache would change; empty if the sample says nothing.
std::string larger_cache_sentence(const MissEstimate& misses, std::uint32_t cache_pages);
std::string cache_conclusion(const MissEstimate& misses, std::uint32_t cache_pages);

}  // namespace dmpc::apps::html
