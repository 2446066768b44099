#include "apps/edge/run/miss_estimate.h"

#include <algorithm>

namespace dmpc::apps {

std::size_t references_of_node(std::uint32_t node_count, std::size_t references_max) {
  constexpr std::size_t least = 1024;
  return std::max(least, references_max / node_count);
}

double MissEstimate::misses(std::uint32_t cache_pages) const {
  return static_cast<double>(curve.misses(cache_pages / every)) * every;
}

MissEstimate estimate_misses(std::vector<svm::ReferenceLog>& logs) {
  MissEstimate estimate;
  for (const svm::ReferenceLog& log : logs) {
    estimate.every = std::max(estimate.every, log.every());
  }
  for (svm::ReferenceLog& log : logs) {
    log.thin_out(estimate.every);
    estimate.curve += svm::MissCurve(log.pages());
  }
  return estimate;
}

}  // namespace dmpc::apps
