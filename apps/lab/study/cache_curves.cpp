#include "apps/lab/study/cache_curves.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/lab/crowd/side_by_side.h"
#include "svm/pages/observers/optimum.h"
#include "svm/pages/replacement.h"

namespace dmpc::apps {
namespace {

using svm::Replacement;
/// By size: of each of the other policies, then of those that are not dmpc's own, then of the optimum.
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
Faults faults_of(CacheCurves::NodeReferences references, std::uint32_t node, const std::vector<std::uint32_t>& sizes,
                 CacheCurves::Policies more, const CacheCurves::Watch& watch) {
  const svm::Optimum optimum(references);
  Faults faults(sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (const Replacement policy : other_policies()) {
      watch.check();
      faults[i].push_back(svm::policy_misses(policy, references, sizes[i], node));
      watch.fed();
    }
  }
  for (const ForeignPolicy& policy : more) {
    const std::vector<std::uint64_t> misses = policy.misses(references, sizes, node, watch.check, watch.fed);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      faults[i].push_back(misses[i]);
    }
  }
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    faults[i].push_back(optimum.misses(sizes[i]));
  }
  return faults;
}

void add(const Faults& more, Faults& sums) {
  for (std::size_t row = 0; row < sums.size(); ++row) {
    std::transform(more[row].begin(), more[row].end(), sums[row].begin(), sums[row].begin(), std::plus());
  }
}

std::string fault_column(std::string_view policy) { return "faults " + std::string(policy); }

/// Returns the policies with columns between lru's and the optimum's, in their order.
std::vector<std::string> names_beside_lru(CacheCurves::Policies more) {
  std::vector<std::string> names;
  for (const Replacement policy : other_policies()) {
    names.emplace_back(svm::name_of(policy));
  }
  std::transform(more.begin(), more.end(), std::back_inserter(names), [](const ForeignPolicy& policy) { return policy.name(); });
  return names;
}

}  // namespace

CacheCurves::CacheCurves(const std::vector<NodeReferences>& nodes, std::uint64_t reference_count,
                         std::vector<std::uint32_t> sizes, Policies more, const Watch& watch)
    : sizes_(std::move(sizes)),
      reference_count_(reference_count),
      faults_(sizes_.size(), std::vector<std::uint64_t>(other_policies().size() + more.size() + 1)) {
  side_by_side(nodes.size(), [&](std::size_t node) -> std::function<void()> {
    svm::MissCurve lru(nodes[node]);
    Faults faults = faults_of(nodes[node], static_cast<std::uint32_t>(node), bounded(sizes_, lru.distinct_pages()), more, watch);
    return [this, faults = std::move(faults), lru = std::move(lru)] {
      lru_ += lru;
      add(faults, faults_);
    };
  });
}

std::uint64_t CacheCurves::cache_count(std::size_t node_count, std::size_t size_count, Policies more) {
  return std::uint64_t{node_count} * size_count * names_beside_lru(more).size();
}

std::vector<Column> CacheCurves::columns(const std::string& share, Policies more) {
  std::vector<Column> columns = {{"cache pages"}, {share, "%", 2}, {"misses lru", "%", 4}, {fault_column("lru")}};
  for (const std::string& name : names_beside_lru(more)) {
    columns.push_back({fault_column(name)});
  }
  columns.push_back({fault_column("optimum")});
  return columns;
}

PlotAxis CacheCurves::size_axis() { return {.label = "cache of a node (pages)", .scale = PlotScale::powers_of_10}; }

Plot CacheCurves::plot(Policies more) {
  std::vector<PlotSeries> policies = {{"lru", fault_column("lru")}};
  std::vector<std::string> names = names_beside_lru(more);
  names.emplace_back("optimum");
  for (const std::string& name : names) {
    policies.push_back({.title = name, .column = fault_column(name), .color = policies.size()});
  }
  return curves("cache_faults", "Page faults", "cache pages", size_axis(), {.label = "faults", .scale = PlotScale::powers_of_10},
                std::move(policies));
}

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
      "--policy", "FILE.so|python:FILE.py:CLASS", [&places](const std::string& place) { places.push_back(place); },
      "A replacement policy of your own, beside dmpc's: a shared library by <dmpc/policy.h>, or a class in a file for Python, by "
      "its "
      "full path, which nobody but you and root can write; may be given several times");
}

std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check) {
  std::vector<ForeignPolicy> policies;
  for (const std::string& place : places) {
    policies.emplace_back(place, check);
  }
  check_names_differ(policies);
  return policies;
}

}  // namespace dmpc::apps
