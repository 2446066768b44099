#include "apps/show/page/conclusions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <vector>

#include "apps/line/amount.h"
#include "apps/line/number_text.h"
#include "apps/run/memory_categories.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps::html {

namespace {

/// Most of the nodes: below this share of them a run tails off.
constexpr double busy_share = 0.5;
/// Of a run: a shorter tail is not worth a sentence.
constexpr double tail_share_min = 0.02;

/// A change that two digits do not show.
constexpr double hardly_less = 0.995;

double share_of(double part, double whole) { return whole > 0 ? part / whole : 0; }

/// "41 %", "0.3 %", "less than 0.1 %".
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

std::string node_text(std::size_t node) { return "node " + std::to_string(node); }

std::size_t largest_at(std::span<const double> values) {
  return static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin());
}

double sum_of(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The share that the largest tenth of the values, at least one, has of their sum.
double top_tenth_share(std::vector<double> values) {
  std::sort(values.begin(), values.end(), std::greater());
  const std::size_t count = std::max<std::size_t>(1, values.size() / 10);
  return share_of(sum_of(std::span(values).first(count)), sum_of(values));
}

template <class ValueOf>
std::vector<double> by_node(const Account& account, const ValueOf& value_of) {
  std::vector<double> values;
  for (std::size_t node = 0; node < account.nodes.size(); ++node) {
    values.push_back(static_cast<double>(value_of(node)));
  }
  return values;
}

/// Of virtual time; never computing.
std::size_t largest_loss(const TimeParts& parts) {
  return 1 + static_cast<std::size_t>(std::max_element(parts.ns.begin() + 1, parts.ns.end()) - (parts.ns.begin() + 1));
}

std::string virtual_losses(const Account& account) {
  const nodes::VirtualReport& report = *account.virtual_time;
  const TimeParts all = parts_of(sum_of_nodes(report), account.waits);
  const auto whole = static_cast<double>(all.total_ns());
  if (whole == 0) {
    return "No virtual time passed.";
  }
  std::string text = "The nodes computed for " + share_text(share_of(static_cast<double>(all.ns[0]), whole)) + " of their time";
  if (const std::size_t loss = largest_loss(all); all.ns[loss] > 0) {
    text += "; most of the rest was \"" + words_of(static_cast<TimePart>(loss), account.waits) + "\", " +
            share_text(share_of(static_cast<double>(all.ns[loss]), whole));
  }
  const std::string even =
      evenness(by_node(account, [&](std::size_t node) { return report.nodes[node].computing_ns; }), "computed for");
  return text + "." + (even.empty() ? "" : " " + even + ".");
}

std::string wall_losses(const Account& account) {
  double busy = 0, asleep = 0, wall = 0;
  for (const NodeAccount& node : account.nodes) {
    busy += static_cast<double>(node.counters.busy_ns);
    asleep += static_cast<double>(node.counters.asleep_ns);
    wall += static_cast<double>(node.counters.wall_ns);
  }
  if (wall == 0) {
    return "No time passed.";
  }
  return "The nodes' threads computed for " + share_text(share_of(busy, wall)) +
         " of their time, slept for want of packets for " + share_text(share_of(asleep, wall)) +
         " and waited for a core of this computer for " + share_text(share_of(std::max(0.0, wall - busy - asleep), wall)) + ".";
}

std::vector<double> busy_shares(const nodes::ActivitySteps& steps) {
  const std::size_t node_count = steps.nodes.size() - 1;  // the host is the last
  std::vector<double> shares(steps.nodes.front().size());
  for (std::size_t node = 0; node < node_count; ++node) {
    for (std::size_t step = 0; step < shares.size(); ++step) {
      const nodes::WorkTimes& times = steps.nodes[node][step];
      shares[step] += static_cast<double>(std::accumulate(times.begin(), times.end(), std::uint64_t{0})) /
                      (static_cast<double>(steps.step_ns) * static_cast<double>(node_count));
    }
  }
  return shares;
}

/// The steps at the end in each of which few nodes were busy.
std::size_t tail_of(std::span<const double> shares) {
  const auto last_busy = std::find_if(shares.rbegin(), shares.rend(), [](double share) { return share >= busy_share; });
  return static_cast<std::size_t>(last_busy - shares.rbegin());
}

}  // namespace

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

std::string loss_conclusion(const Account& account) {
  return account.virtual_time ? virtual_losses(account) : wall_losses(account);
}

std::string time_conclusion(const nodes::ActivitySteps& steps) {
  const std::vector<double> shares = busy_shares(steps);
  if (shares.empty()) {
    return "";
  }
  const auto count = static_cast<double>(shares.size());
  std::string text = "On average " + share_text(std::min(1.0, sum_of(shares) / count)) + " of the nodes were busy";
  const std::size_t tail = tail_of(shares);
  const double tail_share = static_cast<double>(tail) / count;
  if (tail == shares.size()) {
    return text + ", and never half of them at a time.";
  }
  return text +
         (tail_share >= tail_share_min ? "; in the last " + share_text(tail_share) + " of the run it was less than half." : ".");
}

std::string page_conclusion(const svm::PageCounters& pages, const svm::Fetches& fetches) {
  if (pages.faults == 0) {
    return "No page was fetched: each node found all that it looked up at home.";
  }
  const double asked = share_of(static_cast<double>(pages.faults), static_cast<double>(pages.references));
  std::vector<double> served(fetches.peer_count);
  for (std::size_t pair = 0; pair < fetches.by_pair.size(); ++pair) {
    served[pair % fetches.peer_count] += static_cast<double>(fetches.by_pair[pair]);
  }
  const std::vector<double> by_page(fetches.by_page.begin(), fetches.by_page.end());
  const std::string even = fetches.where == svm::PageHomes::host ? "The host, home to all pages, served all"
                           : fetches.where == svm::PageHomes::tree
                               ? "The host, home to all pages, served " +
                                     share_text(share_of(served.back(), static_cast<double>(pages.faults))) +
                                     ", nodes above who asked the others"
                               : evenness(served, "served");
  return counted(pages.faults, "page fault") + " in " + counted(pages.references, "look-up") + " (" + share_text(asked) +
         "); the tenth of the pages that was fetched most had " + share_text(top_tenth_share(by_page)) + " of the fetches. " +
         even + (even.empty() ? "" : ".");
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

std::string cache_conclusion(const MissEstimate& misses, std::uint32_t cache_pages, std::uint32_t page_count) {
  const double own = misses.misses(cache_pages), twice = misses.misses(2 * cache_pages);
  if (own == 0 || cache_pages / misses.every < 1) {
    return "";
  }
  const auto cold = static_cast<double>(misses.curve.cold_misses()) * misses.every;
  const std::string cold_text = share_text(share_of(cold, own)) +
                                " of the misses are of pages that a node looks up for the first time, "
                                "which no cache saves.";
  if (2 * cache_pages >= page_count || twice > hardly_less * own) {
    return "A larger cache would save next to nothing: " + cold_text;
  }
  return "Caches of twice as many pages would miss " + times_text(twice / own) + " as often; " + cold_text;
}

std::string ray_conclusion(std::span<const std::uint64_t> rays, std::uint64_t shot) {
  const std::vector<double> sent(rays.begin(), rays.end());
  const double all = sum_of(sent);
  if (all == 0) {
    return "No ray left the node on which it began.";
  }
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(rays.size())) + 0.5);
  const std::size_t at = largest_at(sent);
  return "A ray went to another node " + times_text(all / static_cast<double>(std::max<std::uint64_t>(shot, 1))) +
         " on average. Most went from " + node_text(at / side) + " to " + node_text(at % side) + ": " +
         share_text(sent[at] / all) + " of all, where an even share were " +
         share_text(1.0 / static_cast<double>(side * (side - 1))) + ".";
}

std::string node_conclusion(const Account& account) {
  const std::vector<double> rays = by_node(account, [&](std::size_t node) { return account.nodes[node].operations.ray_count(); });
  if (rays.size() == 1) {
    return "The one node shot all " + counted(account.operations.ray_count(), "ray") + ".";
  }
  const std::string even = evenness(rays, "shot");
  if (even.empty()) {
    return "No ray was shot.";
  }
  const auto least = static_cast<std::size_t>(std::min_element(rays.begin(), rays.end()) - rays.begin());
  const double mean = sum_of(rays) / static_cast<double>(rays.size());
  return even + " number of rays, " + node_text(least) + " " + times_text(rays[least] / mean) + ".";
}

std::string traffic_conclusion(const Account& account) {
  std::vector<double> bytes;
  for (const nodes::Traffic& traffic : account.sent) {
    bytes.push_back(static_cast<double>(traffic.bytes));
  }
  const nodes::Traffic all = nodes::total(account.sent);
  if (all.bytes == 0) {
    return "No packet was sent.";
  }
  const std::size_t kind = largest_at(bytes);
  std::string name = account.kind_names[kind];
  std::replace(name.begin(), name.end(), '_', ' ');
  std::string text = counted(all.packets, "packet") + ", " + amount_text(static_cast<double>(all.bytes), "bytes") +
                     ", of which " + share_text(share_of(bytes[kind], static_cast<double>(all.bytes))) + " are of kind \"" +
                     name + "\".";
  if (account.virtual_time && !account.virtual_time->busiest_links.empty() && account.virtual_time->total_ns > 0) {
    const nodes::LinkUse& link = account.virtual_time->busiest_links.front();
    text += " The busiest link, from " + link.from + " to " + link.to + ", was held for " +
            share_text(share_of(static_cast<double>(link.busy_ns), static_cast<double>(account.virtual_time->total_ns))) +
            " of the run.";
  }
  return text;
}

std::string memory_conclusion(const Account& account, std::size_t database_bytes) {
  const std::vector<double> used = by_node(account, [&](std::size_t node) { return account.nodes[node].memory_used.total(); });
  const std::size_t fullest = largest_at(used);
  const nodes::MemoryPlan& memory = account.nodes[fullest].memory_used;
  std::vector<double> parts;
  for (const NamedCategory& part : memory_categories) {
    parts.push_back(static_cast<double>(memory[part.category]));
  }
  const std::size_t part = largest_at(parts);
  return "The fullest node, " + node_text(fullest) + ", used " + bytes_text(memory.total()) + ", " +
         share_text(share_of(parts[part], used[fullest])) + " of it for " + memory_categories.at(part).name +
         "; the database has " + bytes_text(database_bytes) + ".";
}

std::string heat_conclusion(const HeatField& field) {
  if (field.kind == core::HeatKind::node || field.kind == core::HeatKind::depth || field.sum() == 0) {
    return "";
  }
  return "The tenth of the pixels with the most " + std::string(core::name_of(field.kind)) + " had " +
         share_text(top_tenth_share(field.values)) + " of all.";
}

}  // namespace dmpc::apps::html
