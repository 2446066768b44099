// The study `cache`: how often nodes miss pages with caches of any size and policy, and what that costs on a machine.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/edge/table/plot.h"
#include "apps/lab/study/engine/study_line.h"
#include "apps/lab/study/policies.h"
#include "apps/lab/study/runs.h"
#include "nodes/machine.h"

namespace dmpc::apps {

/// For each size of the caches the faults of the replacement policies and of the optimum, all for the same references; and, if
/// there is a machine, its time, efficiency and page traffic with lru.
struct CacheStudy {
  static constexpr const char* name = "cache";
  static constexpr const char* description = "How often pages are missed with caches of every size and policy";

  std::uint32_t node_count = 32;           ///< at least 2
  std::vector<std::uint32_t> cache_pages;  ///< sizes in pages; empty: about 12, from 1 to all pages that are not at home
  std::optional<nodes::Machine> machine;   ///< without it nothing is timed
  std::vector<std::string> policy_places;  ///< of policies that are not dmpc's own
  std::vector<ForeignPolicy> policies;     ///< those, once load() has been called

  /// Loads the policies. Throws as they do.
  void load(const std::function<void()>& check) { policies = load_policies(policy_places, check); }

  void add_options(StudyLine line);
  std::vector<Column> columns() const;
  std::vector<Plot> plots() const;
  void measure(StudyRuns& runs, Table& table) const;
  std::vector<std::string> notes(const std::string& scene) const;
  std::string conclusion(const Table& table) const;
};

/// Declares --cache-pages: sizes in pages, about 12 of them where none are given.
void add_cache_pages(OptionSet set, std::vector<std::uint32_t>& cache_pages);

}  // namespace dmpc::apps
