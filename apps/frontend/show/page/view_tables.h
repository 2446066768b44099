// What was seen of a run beyond its counters, as tables, pictures and plots.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/run/run_view.h"
#include "apps/frontend/show/page/number_map.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// A row for each step of time: what all nodes but the host were busy with, in percent of their time. Kinds of work have these
/// names; there are no others. Likewise what they waited for, if waits have names: those of which there are any.
Table step_table(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
                 std::span<const std::string> wait_names = {});
Plot step_plot(const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
               std::span<const std::string> wait_names = {});
/// A row for each node but the host, a column for each step: its share of the time in which it was busy.
NumberMap step_map(const nodes::ActivitySteps& steps);

/// `counts`: from each node, a row, to each, a column.
NumberMap pair_map(std::span<const std::uint64_t> counts, const std::string& title, const std::string& row_label,
                   const std::string& column_label, const std::string& value_label);

/// Fetches as long as half of all, as one of twenty and as one of a hundred, and all of them on average: each with its parts,
/// which add up to the whole.
Table fetch_table(const svm::Fetches& fetches);
Plot fetch_plot(const svm::Fetches& fetches);
/// Each part by itself: its mean, median, and so on.
Table fetch_part_table(const svm::Fetches& fetches);

/// The pages that were fetched most.
Table page_table(const svm::Fetches& fetches);
/// How large a share of the fetches the hottest pages have, for ever more of them.
Table page_share_table(const svm::Fetches& fetches);
Plot page_share_plot();

/// Estimated misses for caches of every size of which the sample tells something, up to all `page_count` pages, with those of the
/// run itself, in percent of its `references`.
Table miss_table(const MissEstimate& estimate, std::uint32_t page_count, std::uint64_t references, std::uint32_t cache_pages,
                 std::uint64_t faults);
Plot miss_plot();

}  // namespace dmpc::apps::html
