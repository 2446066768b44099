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
  const double lost = shares.film_wait + shares.idle_at_end, growth = lost / std::max(1 - lost, 1e-3);
  if (lost <= share_max) {
    return "";
  }
  if (shares.film_wait >= shares.idle_at_end) {
    return "nodes wait for film or are idle at the end for " + percent(lost) + ": " + by_samples(growth, picture);
  }
  // What is left at the end is a few work items, which are as long in a larger picture: its area has to grow.
  const double side = std::sqrt(growth);
  return "nodes are idle at the end or wait for film for " + percent(lost) + ": --resolution=" + whole(side * picture.width) +
         "x" + whole(side * picture.height) + " or more would do";
}

}  // namespace dmpc::apps
