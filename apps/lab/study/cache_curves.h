// What caches of several sizes miss of the same references, under every policy.
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

/// The curves of all nodes together, each with a cache of its own. A value.
class CacheCurves {
 public:
  /// The references of one node, in order; those of one page in a row may be one.
  using NodeReferences = std::span<const svm::PageId>;

  /// Beside dmpc's own.
  using Policies = std::span<const ForeignPolicy>;
  /// Called from any thread while caches are fed.
  struct Watch {
    std::function<void()> check;        ///< often; may throw
    std::function<void()> fed = [] {};  ///< once for each of cache_count()
  };

  /// `reference_count`: those that a share of misses is of. `sizes`: in pages. On all cores. Throws what a policy or check()
  /// does.
  CacheCurves(const std::vector<NodeReferences>& nodes, std::uint64_t reference_count, std::vector<std::uint32_t> sizes,
              Policies more, const Watch& watch);

  static std::uint64_t cache_count(std::size_t node_count, std::size_t size_count, Policies more);
  /// The columns of the cells that row() has. `share`: what the second says that the cache is a share of.
  static std::vector<Column> columns(const std::string& share, Policies more);
  static Plot plot(Policies more);
  static PlotAxis size_axis();
  /// Where the figures come from.
  static std::string note();

  const std::vector<std::uint32_t>& sizes() const { return sizes_; }
  std::vector<Cell> row(std::size_t index, std::uint32_t page_count) const;
  /// One for each size.
  void add_rows(std::uint32_t page_count, Table& table) const;
  /// How many pages the nodes have to do with.
  std::string needs_note() const;

 private:
  std::vector<std::uint32_t> sizes_;
  std::uint64_t reference_count_;
  svm::MissCurve lru_;
  std::vector<std::vector<std::uint64_t>> faults_;  ///< by size: of each of the other policies, of more, then of the optimum
};

/// Declares --cache-pages: sizes in pages, about 12 of them where none are given.
void add_cache_pages(OptionSet set, std::vector<std::uint32_t>& cache_pages);

/// Declares --policy, several times: where policies are, as ForeignPolicy takes it.
void add_policies(OptionSet set, std::vector<std::string>& places);

/// In their order, each with a name of its own. `check` is called meanwhile and may throw. Throws core::InputError as
/// ForeignPolicy does.
std::vector<ForeignPolicy> load_policies(const std::vector<std::string>& places, const std::function<void()>& check);

}  // namespace dmpc::apps
