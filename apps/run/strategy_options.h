// The options of a run beside its picture: a strategy, and the computer that it asks for. Shared by `render` and `study speedup`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/run/runner_kind.h"
#include "apps/scene/database_options.h"
#include "core/base/refusal.h"
#include "dataflow/ray_options.h"
#include "dataflow/regions/balance.h"
#include "dataflow/regions/bsp.h"
#include "nodes/computer_request.h"
#include "nodes/ranks/backoff.h"
#include "svm/page_options.h"

namespace dmpc::apps {

/// As the command line calls it.
const char* name_of(dataflow::Balance balance);
/// As the command line calls it.
const char* name_of(dataflow::CutOrder order);
/// For OptionSet::check_in_the_end(), of all these options: throws core::UsageError for those that do not go with the balance.
void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance);

/// svm: pages travel. replicated: nothing does, every node holds the whole scene. dataflow: rays travel. forest: questions about
/// rays do, and answers.
enum class Strategy : std::uint8_t { svm, replicated, dataflow, forest };
/// As the command line calls it.
const char* name_of(Strategy strategy);

/// Who finds what a ray hits: our grid, or Embree (with strategy replicated only).
enum class TracerChoice : std::uint8_t { grid, embree };

/// What calls the nodes' programs, and which machine is modelled if one is.
struct RunnerOptions {
  RunnerKind kind = RunnerKind::threads;
  std::string machine_name = "ipsc2";     ///< to be modelled: a preset's name or a machine file
  std::uint32_t timeout_seconds = 600;    ///< with ranks of which nothing is heard
  nodes::Idle idle = nodes::Idle::sleep;  ///< what ranks' communicating threads do meanwhile, as their processors have it
};

/// A strategy, and all that it asks of the computer.
struct StrategyOptions {
  Strategy strategy = Strategy::svm;
  nodes::ComputerRequest computer;  ///< with the machine, once it is read (run_strategy.h)
  RunnerOptions runner;
  svm::PageOptions pages;
  dataflow::RayOptions rays = {.topology = nodes::TopologyKind::hypercube};
  TracerChoice tracer = TracerChoice::grid;
  bool has_several_frames = false;  ///< pictures of the scene follow each other on the same nodes
};

/// Declares --nodes; `standard` is what help says of how many there are else.
void add_nodes_option(OptionSet options, std::uint32_t& count, const std::string& standard);
/// Declares --strategy.
void add_strategy_option(OptionSet options, Strategy& strategy);
/// Declares --node-memory.
void add_memory_option(OptionSet options, std::optional<std::size_t>& node_memory_bytes);
/// Declares --machine; `when` is what its help says of when it goes, such as " (virtual)".
void add_machine_option(OptionSet options, std::string& machine_name, const std::string& when);
/// Declares the options of svm, replicated and forest but --count-pages, in a group of their own. `in_flight_default`: what help
/// says of the default of --in-flight in place of what covers every runner.
void add_page_options(OptionSet options, svm::PageOptions& pages, const std::string& in_flight_default = "");
/// Declares the options of dataflow in a group of their own.
void add_ray_options(OptionSet options, dataflow::RayOptions& rays);
/// Adds the options that say how regions are cut.
void add_balance_options(OptionSet options, dataflow::BalanceOptions& balance);
/// The option of a field alone.
void add_option(OptionSet options, const core::Field& field, svm::PageOptions& pages);

/// For OptionSet::check_in_the_end(): throws core::UsageError for options, of those declared above or --count-pages, that do not
/// go with the strategy or each other.
void check_together(const OptionSet& options, const StrategyOptions& strategy);
/// The database that a strategy has unless another one is asked for: forest's is one tree, whose subtrees take up to 4 KiB.
DatabaseOptions usual_database(Strategy strategy);
/// For OptionSet::check_in_the_end(), of options that are declared by add_options(OptionSet, DatabaseOptions&), too: chooses what
/// a strategy needs where nothing is said. Throws core::UsageError for a database that the strategy does not take.
void settle_database(const OptionSet& options, Strategy strategy, DatabaseOptions& database);

}  // namespace dmpc::apps
