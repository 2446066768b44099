#include "apps/lab/study/cache_curves.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/lab/crowd/side_by_side.h"
#include "core/base/ranges.h"
#include "svm/pages/observers/optimum.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

using svm::Replacement;
/// As CacheCurves keeps them.
using Faults = std::vector<std::vector<std::uint64_t>>;

/// Returns the policies other than lru, whose misses are known for all sizes at once, in the order of their columns.
std::vector<Replacement> other_policies() {
  std::vector<Replacement> policies;
  for (std::size_t i = 0; i < svm::policy_kinds().size(); ++i) {
    if (const auto policy = static_cast<Replacement>(i); policy != Replacement::lru) {
      policies.push_back(policy);
    }
  }
  return policies;
}

/// A cache for all pages fetches each once.
std::vector<std::uint32_t> bounded(std::vector<std::uint32_t> sizes, std::uint32_t distinct_pages) {
  for (std::uint32_t& size : sizes) {
    size = std::min(size, std::max(1U, distinct_pages));
  }
  return sizes;
}

/// `sizes` are limited by the number of the references' pages.
Faults faults_of(const CacheCurves::NodeReferences& references, std::uint32_t node, const std::vector<std::uint32_t>& sizes,
                 CacheCurves::Policies more, const CacheCurves::Watch& watch) {
  const svm::Optimum optimum(references.pages);
  Faults faults(sizes.size()), costs(sizes.size());
  std::uint64_t cost = 0;
  const svm::Missed pay = [&](std::size_t reference) { cost += references.prices[reference]; };
  const svm::Missed missed = references.prices.empty() ? svm::Missed() : pay;
  const auto faults_with = [&](Replacement policy, std::size_t size) {
    watch.check();
    return svm::policy_misses(policy, references.pages, sizes[size], node, missed);
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (missed) {
      faults_with(Replacement::lru, i);  // their number is known
      costs[i].push_back(std::exchange(cost, 0));
    }
    for (const Replacement policy : other_policies()) {
      faults[i].push_back(faults_with(policy, i));
      costs[i].push_back(std::exchange(cost, 0));
      watch.fed();
    }
  }
  for (const ForeignPolicy& policy : more) {
    const std::vector<PricedFaults> priced =
        policy.misses(references.pages, sizes, node, watch.check, watch.fed, references.prices);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      faults[i].push_back(priced[i].count);
      costs[i].push_back(priced[i].cost);
    }
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    faults[i].push_back(optimum.misses(sizes[i], missed));
    costs[i].push_back(std::exchange(cost, 0));
    if (missed) {
      faults[i].insert(faults[i].end(), costs[i].begin(), costs[i].end());
    }
  }
  return faults;
}

void add(const Faults& more, Faults& sums) {
  for (std::size_t row = 0; row < sums.size(); ++row) {
    std::transform(more[row].begin(), more[row].end(), sums[row].begin(), sums[row].begin(), std::plus());
  }
}

bool are_priced(const std::vector<CacheCurves::NodeReferences>& nodes) {
  return std::ranges::any_of(nodes, [](const auto& node) { return !node.prices.empty(); });
}

/// Returns the policies with columns, in their order.
std::vector<std::string> policy_names(CacheCurves::Policies more) {
  std::vector<std::string> names = {"lru"};
  for (const Replacement policy : other_policies()) {
    names.emplace_back(svm::name_of(policy));
  }
  std::transform(more.begin(), more.end(), std::back_inserter(names), [](const ForeignPolicy& policy) { return policy.name(); });
  names.emplace_back("optimum");
  return names;
}

/// `what` begins the columns' names.
Plot plot_of(const std::string& name, const std::string& title, const std::string& what, CacheCurves::Policies more) {
  std::vector<PlotSeries> policies;
  for (const std::string& policy : policy_names(more)) {
    policies.push_back({.title = policy, .column = what + " " + policy, .color = policies.size()});
  }
  return curves(name, title, "cache pages", CacheCurves::size_axis(), {.label = what, .scale = PlotScale::powers_of_10},
                std::move(policies));
}

}  // namespace

CacheCurves::CacheCurves(const std::vector<NodeReferences>& nodes, std::uint64_t reference_count,
                         std::vector<std::uint32_t> sizes, Policies more, const Watch& watch)
    : sizes_(std::move(sizes)),
      reference_count_(reference_count),
      faults_(sizes_.size(), std::vector<std::uint64_t>((are_priced(nodes) ? 2 : 1) * policy_names(more).size() - 1)) {
  side_by_side(nodes.size(), [&](std::size_t node) -> std::function<void()> {
    svm::MissCurve lru(nodes[node].pages);
    Faults faults = faults_of(nodes[node], static_cast<std::uint32_t>(node), bounded(sizes_, lru.distinct_pages()), more, watch);
    return [this, faults = std::move(faults), lru = std::move(lru)] {
      lru_ += lru;
      add(faults, faults_);
    };
  });
}

std::uint64_t CacheCurves::cache_count(std::size_t node_count, std::size_t size_count, Policies more) {
  return std::uint64_t{node_count} * size_count * (other_policies().size() + more.size());
}

std::vector<Column> CacheCurves::columns(const std::string& share, Policies more, bool have_prices) {
  std::vector<Column> columns = {{"cache pages"}, {share, "%", 2}, {"misses lru", "%", 4}};
  for (const char* const what : have_prices ? std::vector{"faults", "cost"} : std::vector{"faults"}) {
    for (const std::string& name : policy_names(more)) {
      columns.push_back({std::string(what) + " " + name});
    }
  }
  return columns;
}

PlotAxis CacheCurves::size_axis() { return {.label = "cache of a node (pages)", .scale = PlotScale::powers_of_10}; }

Plot CacheCurves::plot(Policies more) { return plot_of("cache_faults", "Page faults", "faults", more); }

Plot CacheCurves::cost_plot(Policies more) { return plot_of("cache_costs", "Cost of page faults", "cost", more); }

std::string CacheCurves::note() {
  return "Lru: from the stack distances of the references (Mattson, Gecsei, Slutz and Traiger, 1970). Other policies: by a cache "
         "of each size, fed with them. Optimum: the page that leaves is the one needed last (Belady, 1966).";
}

std::vector<Cell> CacheCurves::row(std::size_t index, std::uint32_t page_count) const {
  const std::uint64_t misses = lru_.misses(sizes_[index]);
  std::vector<Cell> cells = {std::uint64_t{sizes_[index]}, percent_of<std::uint64_t>(sizes_[index], page_count),
                             percent_of<std::uint64_t>(misses, reference_count_), misses};
  cells.insert(cells.end(), faults_[index].begin(), faults_[index].end());
  return cells;
}

void CacheCurves::add_rows(std::uint32_t page_count, Table& table) const {
  for (std::size_t size = 0; size < sizes_.size(); ++size) {
    table.add_row(row(size, page_count));
  }
}

std::string CacheCurves::needs_note() const {
  if (lru_.references() == 0) {
    return "No node references a page of another.";
  }
  return "The node that references most has to do with " + counted(lru_.distinct_pages(), "different page") +
         " of others; from " + counted(std::max(lru_.sufficient_pages(), 1U), "frame") +
         " on lru faults on each page's first reference only, " + counted(lru_.cold_misses(), "time") + " in all.";
}

void add_cache_pages(OptionSet set, std::vector<std::uint32_t>& cache_pages) {
  constexpr std::uint32_t most = 0x7fffffff;
  set.add_text(
      "--cache-pages", "N,N,... [12 from 1 to all]",
      [&cache_pages](const std::string& text) { cache_pages = parse_numbers(text, "--cache-pages", most); },
      "Sizes of the caches in pages");
}

void add_policies(OptionSet set, std::vector<std::string>& places) {
  set.add_texts(
      "--policy", ForeignPolicy::places, [&places](const std::string& place) { places.push_back(place); },
      "A replacement policy of your own, beside dmpc's: a shared library by <dmpc/policy.h>, or a class in a file for Python, by "
      "its "
      "full path, which nobody but you and root can write; may be given several times");
}

std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check) {
  std::vector<ForeignPolicy> policies =
      core::mapped<ForeignPolicy>(places, [&](const std::string& place) { return ForeignPolicy("--policy", place, check); });
  check_names_differ(policies);
  return policies;
}

}  // namespace dmpc::apps
