#include "apps/frontend/run/miss_estimate.h"

#include <algorithm>

#include "svm/pages/share.h"

namespace dmpc::apps {

std::size_t references_of_node(std::uint32_t node_count, std::size_t references_max) {
  constexpr std::size_t least = 1024;
  return std::max(least, references_max / node_count);
}

double MissEstimate::misses(std::uint32_t cache_pages) const {
  return static_cast<double>(curve.misses(cache_pages / every)) * every;
}

double MissEstimate::half_misses(std::uint32_t cache_pages) const {
  return static_cast<double>(half.misses(cache_pages / every / 2)) * every * 2;
}

std::uint32_t MissEstimate::cache_pages_min() const {
  constexpr std::uint32_t sampled_pages_least = 4;
  return every == 1 ? 1 : sampled_pages_least * every;
}

MissEstimate estimate_misses(std::vector<svm::ReferenceLog>& logs) {
  MissEstimate estimate;
  for (const svm::ReferenceLog& log : logs) {
    estimate.every = std::max(estimate.every, log.every());
  }
  for (svm::ReferenceLog& log : logs) {
    log.thin_out(estimate.every);
    estimate.curve += svm::MissCurve(log.pages());
    if (estimate.every > 1 && estimate.every < svm::Share::every_max) {
      svm::ReferenceLog half = log;
      half.thin_out(2 * estimate.every);
      estimate.half += svm::MissCurve(half.pages());
    }
  }
  return estimate;
}

}  // namespace dmpc::apps
