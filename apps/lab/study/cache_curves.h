// Misses of caches of several sizes for the same references, under every policy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "apps/policy/foreign_policy.h"
#include "svm/pages/observers/miss_curve.h"
#include "svm/pages/page.h"

namespace dmpc::apps {

/// The curves of all nodes together; each node has its own cache. A value type.
class CacheCurves {
 public:
  /// The references of one node, in order; consecutive references to one page may count as one.
  struct NodeReferences {
    std::span<const svm::PageId> pages;
    std::span<const std::uint32_t> prices = {};  ///< of a miss of each, if costs are wanted
  };

  /// Policies other than dmpc's own.
  using Policies = std::span<const ForeignPolicy>;
  /// Called from any thread while references are fed to the caches.
  struct Watch {
    std::function<void()> check;        ///< called often; may throw
    std::function<void()> fed = [] {};  ///< called once for each of cache_count()
  };

  /// `reference_count` is the denominator of a share of misses; `sizes` are in pages. Uses all cores. Throws what a policy or
  /// check() throws.
  CacheCurves(const std::vector<NodeReferences>& nodes, std::uint64_t reference_count, std::vector<std::uint32_t> sizes,
              Policies more, const Watch& watch);

  static std::uint64_t cache_count(std::size_t node_count, std::size_t size_count, Policies more);
  /// Returns the columns of the cells that row() has. `share` heads the second: the whole of which the cache is a share. With
  /// prices there is a cost for each number of faults: the sum of their prices.
  static std::vector<Column> columns(const std::string& share, Policies more, bool have_prices = false);
  static Plot plot(Policies more);
  static Plot cost_plot(Policies more);
  static PlotAxis size_axis();
  /// Returns a note on the source of the figures.
  static std::string note();

  const std::vector<std::uint32_t>& sizes() const { return sizes_; }
  std::vector<Cell> row(std::size_t index, std::uint32_t page_count) const;
  void add_rows(std::uint32_t page_count, Table& table) const;
  /// Returns a note on how many pages the nodes use.
  std::string needs_note() const;

 private:
  std::vector<std::uint32_t> sizes_;
  std::uint64_t reference_count_;
  svm::MissCurve lru_;
  /// By size: faults of each of the other policies, of `more`, then of the optimum; with prices then costs, of lru first.
  std::vector<std::vector<std::uint64_t>> faults_;
};

/// Declares --cache-pages: sizes in pages, about 12 of them by default.
void add_cache_pages(OptionSet set, std::vector<std::uint32_t>& cache_pages);

/// Declares --policy, which may be given several times: the location of a policy, as ForeignPolicy takes it.
void add_policies(OptionSet set, std::vector<std::string>& places);

/// Loads them in their order; each has its own name. `check` is called meanwhile and may throw. Throws core::InputError as
/// ForeignPolicy does.
std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check);

}  // namespace dmpc::apps
