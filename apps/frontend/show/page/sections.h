// Sections that the pages of renders and of programs of one's own have in common.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/frontend/run/miss_estimate.h"
#include "apps/frontend/show/page/losses.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/observers/activity_profile.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/virtual/virtual_times.h"
#include "svm/pages/node_program.h"
#include "svm/pages/observers/fetch_observer.h"

namespace dmpc::apps::html {

/// Adds a section about a table that has a row per node; the plots are of its columns.
void add_node_section(Page& page, const std::string& heading, const std::string& conclusion, const Table& table,
                      const std::vector<Plot>& plots);
void add_losses(Page& page, const Losses& losses);
/// Adds a section; nothing if no steps were observed. `is_virtual`: in virtual time; threads share a computer's cores, so that
/// how busy they were says nothing about a machine, nor what fetches took. `remark` names the run if there were several; `note`
/// is about the table.
void add_steps(Page& page, const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
               std::span<const std::string> wait_names, bool is_virtual, const std::string& remark, const std::string& note);
/// Adds the sections on pages and on their fetches, with the pairs of nodes if `has_pairs`.
void add_pages(Page& page, const svm::PageCounters& pages, const svm::Fetches& fetches, bool is_virtual, bool has_pairs,
               const std::string& remark);
/// Adds a section on the misses of other caches, in a run with caches of `cache_pages`.
void add_misses(Page& page, const MissEstimate& misses, std::uint32_t page_count, std::uint32_t cache_pages,
                const svm::PageCounters& pages, const std::string& remark);
/// Adds the ways of messages over a modelled machine's links.
void add_links(Page& page, const nodes::VirtualReport& report);
/// Adds nothing if all nodes are in one process.
void add_ranks(Page& page, const std::vector<nodes::RankFigures>& ranks);

}  // namespace dmpc::apps::html
