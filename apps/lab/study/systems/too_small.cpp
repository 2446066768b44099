#include "apps/lab/study/systems/too_small.h"

#include <algorithm>
#include <cmath>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps {
namespace {

constexpr double share_max = 0.5;

std::string whole(double number) { return fixed(std::ceil(number), 0); }

/// The film's way takes as long with more samples, while all else grows with them.
std::string by_samples(double growth, const PictureSize& picture) {
  return "--samples=" + whole(growth * picture.samples) + " or more would do";
}

}  // namespace

std::string too_small(const RunShares& shares, const PictureSize& picture) {
  const auto percent = [](double share) { return fixed(100 * share, 0) + " % of the time"; };
  if (shares.host_busy > share_max) {
    return "the host is busy for " + percent(shares.host_busy) + ": " +
           by_samples(shares.host_busy / (share_max * std::max(shares.computing, 1e-3)), picture);
  }
  if (shares.film_wait > share_max) {
    return "nodes wait for film for " + percent(shares.film_wait) + ": " +
           by_samples(shares.film_wait / std::max(1 - shares.film_wait, 1e-3), picture);
  }
  if (shares.idle_at_end > share_max) {
    // What is left at the end is a few work items, which are as long in a larger picture: its area has to grow.
    const double side = std::sqrt(shares.idle_at_end / std::max(1 - shares.idle_at_end, 1e-3));
    return "nodes are idle at the end for " + percent(shares.idle_at_end) + ": --resolution=" + whole(side * picture.width) +
           "x" + whole(side * picture.height) + " or more would do";
  }
  return "";
}

}  // namespace dmpc::apps
