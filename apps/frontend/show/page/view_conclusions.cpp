#include "apps/frontend/show/page/view_conclusions.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/show/page/shares.h"

namespace dmpc::apps::html {

namespace {

/// Most of the nodes: below this share of them a run tails off.
constexpr double busy_share = 0.5;
/// The share of a run: a shorter tail is not worth a sentence.
constexpr double tail_share_min = 0.02;

/// A change that two digits do not show.
constexpr double hardly_less = 0.995;

std::vector<double> busy_shares(const nodes::ActivitySteps& steps) {
  const std::size_t node_count = steps.nodes.size() - 1;  // the host is the last
  std::vector<double> shares(steps.nodes.front().size());
  for (std::size_t node = 0; node < node_count; ++node) {
    for (std::size_t step = 0; step < shares.size(); ++step) {
      const nodes::WorkTimes& times = steps.nodes[node][step];
      shares[step] += static_cast<double>(std::accumulate(times.begin(), times.end(), std::uint64_t{0})) /
                      static_cast<double>(steps.length_ns(step) * node_count);
    }
  }
  return shares;
}

/// The steps at the end in each of which few nodes were busy.
std::size_t tail_of(std::span<const double> shares) {
  const auto last_busy = std::find_if(shares.rbegin(), shares.rend(), [](double share) { return share >= busy_share; });
  return static_cast<std::size_t>(last_busy - shares.rbegin());
}

/// What most of the waits of all nodes but the host, which is the last, were for; empty where nothing was waited for.
std::string wait_sentence(const nodes::ActivitySteps& steps, std::span<const std::string> names) {
  nodes::WaitTimes sums{};
  for (std::size_t node = 0; node + 1 < steps.waits.size(); ++node) {
    for (const nodes::WaitTimes& times : steps.waits[node]) {
      std::transform(sums.begin(), sums.end(), times.begin(), sums.begin(), std::plus());
    }
  }
  const auto most = static_cast<std::size_t>(std::max_element(sums.begin(), sums.end()) - sums.begin());
  if (names.empty() || sums.at(most) == 0) {
    return "";
  }
  return " Most of what they waited was \"" + names[most] + "\".";
}

}  // namespace

std::string time_conclusion(const nodes::ActivitySteps& steps, std::span<const std::string> wait_names) {
  const std::vector<double> shares = busy_shares(steps);
  if (shares.empty()) {
    return "";
  }
  const auto count = static_cast<double>(shares.size());
  std::string text = "On average " + share_text(std::min(1.0, sum_of(shares) / count)) + " of the nodes were busy";
  const std::size_t tail = tail_of(shares);
  const double tail_share = static_cast<double>(tail) / count;
  if (tail == shares.size()) {
    text += ", and never half of them at a time.";
  } else {
    text += tail_share >= tail_share_min ? "; in the last " + share_text(tail_share) + " of the run it was less than half." : ".";
  }
  return text + wait_sentence(steps, wait_names);
}

std::string page_conclusion(const svm::PageCounters& pages, const svm::Fetches& fetches) {
  if (pages.faults == 0) {
    return "No page was fetched: each node found all that it looked up at home.";
  }
  std::vector<double> served(fetches.peer_count);
  for (std::size_t pair = 0; pair < fetches.by_pair.size(); ++pair) {
    served[pair % fetches.peer_count] += static_cast<double>(fetches.by_pair[pair]);
  }
  const std::vector<double> by_page(fetches.by_page.begin(), fetches.by_page.end());
  const std::string even = fetches.where == svm::PageHomes::host ? "The host, home to all pages, served all"
                           : fetches.where == svm::PageHomes::tree
                               ? "The host, home to all pages, served " +
                                     share_text(share_of(served.back(), static_cast<double>(pages.faults))) +
                                     ", nodes above the requester the others"
                               : evenness(served, "served");
  return grouped(pages.misses) + " of " + counted(pages.references, "look-up") + " missed (" +
         percent_text(percent_of(static_cast<double>(pages.misses), static_cast<double>(pages.references)), 2) + "), with " +
         counted(pages.faults, "page fault") +
         ": one page is fetched for all that wait for it. The tenth of the pages that was fetched most had " +
         share_text(top_tenth_share(by_page)) + " of the fetches. " + even + (even.empty() ? "" : ".");
}

std::string fetch_conclusion(const svm::Fetches& fetches) {
  if (fetches.sample.empty()) {
    return "";
  }
  std::vector<double> totals, parts(svm::fetch_part_names.size());
  for (const svm::Fetch& fetch : fetches.sample) {
    totals.push_back(static_cast<double>(fetch.total_ns()));
    for (std::size_t part = 0; part < parts.size(); ++part) {
      parts[part] += static_cast<double>(fetch.part_ns[part]);
    }
  }
  const double whole = sum_of(totals);
  if (whole == 0) {
    return "A fetch takes no time on this machine.";
  }
  const std::size_t part = largest_at(parts);
  return "A fetch takes " + amount_text(whole / static_cast<double>(totals.size()), "ns") +
         " on average; the largest part of it, " + share_text(parts[part] / whole) + ", is \"" +
         std::string(svm::fetch_part_names[part]) + "\".";
}

std::string larger_cache_sentence(const MissEstimate& misses, std::uint32_t cache_pages) {
  const double own = misses.misses(cache_pages), twice = misses.misses(2 * cache_pages);
  if (own == 0 || cache_pages / misses.every < 1) {
    return "";
  }
  return twice > hardly_less * own ? "A larger cache would save almost nothing."
                                   : "Twice the cache would fault " + times_text(twice / own) + " as often.";
}

std::string cache_conclusion(const MissEstimate& misses, std::uint32_t cache_pages) {
  const std::string larger = larger_cache_sentence(misses, cache_pages);
  const auto cold = static_cast<double>(misses.curve.cold_misses()) * misses.every;
  return larger.empty() ? ""
                        : larger + " " + share_text(share_of(cold, misses.misses(cache_pages))) +
                              " of the faults are of pages that a node looks up for the first time, which no cache avoids.";
}

}  // namespace dmpc::apps::html
