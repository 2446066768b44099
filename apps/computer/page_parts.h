// What the pages of all programs on the computer have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/frontend/help/glossary.h"
#include "apps/frontend/show/page/losses.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/show/page/view_tables.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"
#include "nodes/machine.h"
#include "nodes/ranks/rank_figures.h"

namespace dmpc::apps::html {

/// Pairs of more nodes cannot be told apart, and they would make a page of tens of megabytes.
inline constexpr std::uint32_t readable_nodes_max = 256;

/// By alphabet. Thread-safe.
std::span<const GlossaryEntry> page_words();

/// Whose page it is: that of the program `name`.
PageSpeaker speaker(const std::string& name);

/// Puts where it is from, what it is of and what the program came to at the beginning of a page.
void begin_page(Page& page, const Origin& origin, const Facts& facts, const std::string& result, std::uint32_t node_count);

/// This process is the program `name`.
Origin program_origin(const std::string& name);

/// The computer, runner and what disturbs it.
Facts computer_facts(const ProgramOptions& options);

/// How often an operation was charged.
struct OperationCount {
  std::string name;
  std::uint64_t count = 0;
  std::optional<double> today_ns;  ///< as the program declares it
  std::uint64_t each_ps = 0;       ///< on the modelled machine
};
/// A row for each; on a modelled `machine` with what it takes of the nodes' computing.
Table operation_table(const std::vector<OperationCount>& operations, const nodes::Machine* machine);
void add_operations(Page& page, const std::vector<OperationCount>& operations, const nodes::Machine* machine);

/// Nothing where nodes are in one process.
void add_ranks(Page& page, const std::vector<nodes::RankFigures>& ranks);

void add_losses(Page& page, const Losses& losses);
/// `remark`: of which run it is, if there were several.
void add_steps(Page& page, const nodes::ActivitySteps& steps, const std::vector<std::string>& work_names,
               const std::string& remark);

}  // namespace dmpc::apps::html
