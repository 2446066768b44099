// Parts that the reports of all user programs share.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/frontend/help/glossary.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/table/table.h"
#include "nodes/machine.h"

namespace dmpc::apps::html {

/// A matrix of more nodes is not legible, and would make a page of tens of megabytes.
inline constexpr std::uint32_t readable_nodes_max = 256;

/// In alphabetical order. Thread-safe.
std::span<const GlossaryEntry> page_words();

/// Begins a page with its origin, its facts and the program's result.
void begin_page(Page& page, const Origin& origin, const Facts& facts, const std::string& result, std::uint32_t node_count);

/// Returns the origin for this process, the program `name`.
Origin program_origin(const std::string& name);

/// Describes the computer, the runner and chaos.
Facts computer_facts(const ProgramOptions& options);

/// How often an operation was charged.
struct OperationCount {
  std::string name;
  std::uint64_t count = 0;
  std::optional<double> today_ns;  ///< as declared by the program
  std::uint64_t each_ps = 0;       ///< on the modelled machine
};
/// Returns a row per operation; with a modelled `machine` also its share of the nodes' computing.
Table operation_table(const std::vector<OperationCount>& operations, const nodes::Machine* machine);
void add_operations(Page& page, const std::vector<OperationCount>& operations, const nodes::Machine* machine);

}  // namespace dmpc::apps::html
