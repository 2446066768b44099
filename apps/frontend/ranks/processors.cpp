#include "apps/frontend/ranks/processors.h"

#include <sched.h>

#include <algorithm>
#include <sstream>

#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// Thirds add up to ones.
constexpr double rounding = 1e-6;

}  // namespace

RankProcessors own_processors(const std::string& host) {
  RankProcessors own{.host = host, .numbers = {}};
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof(allowed), &allowed) == 0) {
    for (int number = 0; number < CPU_SETSIZE; ++number) {
      if (CPU_ISSET(number, &allowed)) {
        own.numbers.push_back(number);
      }
    }
  }
  return own;
}

std::string text_of(const RankProcessors& processors) {
  return processors.host + joined(processors.numbers, "", [&](const int number) { return " " + std::to_string(number); });
}

RankProcessors parse_processors(const std::string& text) {
  std::istringstream words(text);
  RankProcessors found;
  words >> found.host;
  for (int number = 0; words >> number;) {
    found.numbers.push_back(number);
  }
  core::expect(words.eof() && !found.host.empty(), "processors are a host and numbers");
  return found;
}

double share_of_processors(const std::vector<RankProcessors>& by_rank, std::uint32_t rank) {
  const RankProcessors& own = by_rank.at(rank);
  double share = 0.0;
  for (const int number : own.numbers) {
    const auto may_use_it = [&](const RankProcessors& other) {
      return other.host == own.host && std::binary_search(other.numbers.begin(), other.numbers.end(), number);
    };
    share += 1.0 / static_cast<double>(std::count_if(by_rank.begin(), by_rank.end(), may_use_it));
  }
  return share;
}

std::uint32_t default_nodes_on(double processor_share) {
  return static_cast<std::uint32_t>(std::max(1.0, processor_share + rounding - 1.0));
}

nodes::Idle default_idle(double processor_share, std::uint32_t node_count_here) {
  return processor_share + rounding >= node_count_here + 1.0 ? nodes::Idle::spin : nodes::Idle::sleep;
}

}  // namespace dmpc::apps
