// A run's recorded data beyond its counters, as tables, pictures and plots.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/frontend/run/run_view.h"
#include "apps/frontend/show/page/number_map.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// A row for each time step: the activities of all nodes except the host, in percent of their time. `work_names` are the kinds of
/// work. Likewise for waits, if they have names, without those that do not occur.
Table step_table(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
                 std::span<const std::string> wait_names = {});
Plot step_plot(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
               std::span<const std::string> wait_names = {});
/// A row for each node except the host, a column for each step: its share of busy time.
NumberMap step_map(const nodes::ActivitySteps& steps);

/// `counts`: rows are senders, columns receivers.
NumberMap pair_map(std::span<const std::uint64_t> counts, const std::string& title, const std::string& row_label,
                   const std::string& column_label, const std::string& value_label);

/// The median, 95th and 99th percentile and the mean of fetch times, each with its parts, which add up to the whole.
Table fetch_table(const svm::Fetches& fetches);
Plot fetch_plot(const svm::Fetches& fetches);
/// Statistics of each part: its mean, median, and so on.
Table fetch_part_table(const svm::Fetches& fetches);

/// The hottest pages.
Table page_table(const svm::Fetches& fetches);
/// The share of fetches of the hottest pages, for increasing numbers of pages.
Table page_share_table(const svm::Fetches& fetches);
Plot page_share_plot();

/// Estimated misses for all cache sizes that the sample covers, up to `page_count` pages, and the misses of the run itself, in
/// percent of its `references`.
Table miss_table(const MissEstimate& estimate, std::uint32_t page_count, std::uint64_t references, std::uint32_t cache_pages,
                 std::uint64_t faults);
Plot miss_plot();

}  // namespace dmpc::apps::html
