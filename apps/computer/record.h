// What is known of a program's run once it is done.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "apps/computer/options.h"
#include "apps/computer/packet_pairs.h"
#include "apps/computer/plan.h"
#include "apps/edge/show/trace/view.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/runner.h"
#include "nodes/watch/activity_profile.h"
#include "nodes/watch/trace.h"

namespace dmpc::apps {

/// A node when all is over.
struct ProgramNode {
  nodes::NodeCounters counters;
  nodes::Charges charges;
  std::vector<std::size_t> used_bytes;  ///< of each piece of memory
};

/// What a page shows of a run beyond its counters.
struct ProgramView {
  nodes::ActivitySteps steps;
  std::optional<PacketPairs> pairs;  ///< of few enough nodes
};

/// A view, as far as it has references.
struct ProgramRecord {
  std::string name;  ///< of the program
  const ProgramOptions& options;
  const ProgramPlan& plan;
  std::vector<ProgramNode> nodes;
  std::vector<nodes::RankFigures> ranks;  ///< where there are any
  double wall_seconds = 0;
  std::optional<nodes::VirtualReport> virtual_time;
  std::string result;  ///< what it came to
  std::optional<nodes::Trace> trace;
  std::optional<ProgramView> view;  ///< for a report
};

/// Of all nodes together.
nodes::Traffic sent(const ProgramRecord& record, Index packet);
nodes::Traffic sent(const ProgramRecord& record);

/// "8 nodes" or "8 nodes of ipsc2".
std::string computer_text(const ProgramOptions& options);
/// "; 1,200 packets between 3 ranks"; empty where there are none.
std::string ranks_text(const std::vector<nodes::RankFigures>& ranks);

/// "83.5 us of virtual time, 12.0 % of it computing", of so many nodes together.
std::string virtual_time_text(std::uint64_t total_ns, std::uint64_t computing_ns, std::uint32_t node_count);

/// How long it took, what travelled and what a node takes, a line or two.
std::string summary(const ProgramRecord& record);

/// All counters as JSON, with a line end. The keys are an interface: names with units last.
std::string stats_json(const ProgramRecord& record);

/// Writes the trace in the format that its file's ending says.
void write_trace(const ProgramRecord& record, std::ostream& output);
/// The same of any program's; what is said of the run is added to `view`.
void write_view(TraceView view, const std::string& name, const ProgramOptions& options, std::ostream& output);

}  // namespace dmpc::apps
