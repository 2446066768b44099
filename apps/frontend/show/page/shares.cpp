#include "apps/frontend/show/page/shares.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include "apps/frontend/line/number_text.h"

namespace dmpc::apps::html {

double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

std::string share_text(double share) {
  const double percent = 100 * share;
  if (percent > 0 && percent < 0.1) {
    return "less than 0.1 %";
  }
  if (percent > 99.9 && percent < 100) {
    return "more than 99.9 %";
  }
  const bool is_whole = percent >= 10 || percent == 0;
  return percent_text(percent, is_whole && !(percent < 100 && percent >= 99.5) ? 0 : 1);
}

std::string times_text(double factor) { return fixed(factor, 2) + " times"; }

std::size_t largest_at(std::span<const double> values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double sum_of(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double top_tenth_share(std::vector<double> values) {
  std::sort(values.begin(), values.end(), std::greater());
  const std::size_t count = std::max<std::size_t>(1, values.size() / 10);
  return share_of(sum_of(std::span(values).first(count)), sum_of(values));
}

std::string evenness(std::span<const double> values, const std::string& what) {
  const double mean = share_of(sum_of(values), static_cast<double>(values.size()));
  if (values.size() < 2 || mean == 0) {
    return "";
  }
  const std::size_t most = largest_at(values);
  const double factor = values[most] / mean;
  return factor < 1.005 ? "All nodes " + what + " the same"
                        : "Node " + std::to_string(most) + " " + what + " " + times_text(factor) + " the mean";
}

}  // namespace dmpc::apps::html
