// Options of a run apart from its picture: the strategy and the computer. Shared by `render` and `study speedup`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
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

class ForeignPolicy;

/// The name on the command line.
const char* name_of(dataflow::Balance balance);
const char* name_of(dataflow::CutOrder order);
/// For OptionSet::check_in_the_end(): throws core::UsageError for options that are incompatible with the balance.
void check_regions(const OptionSet& options, const dataflow::BalanceOptions& balance);

/// svm: pages travel. replicated: nothing travels, since every node holds the whole scene. dataflow: rays travel. forest: queries
/// about rays travel, and their answers.
enum class Strategy : std::uint8_t { svm, replicated, dataflow, forest };
const char* name_of(Strategy strategy);

/// The ray tracer: our grid, or Embree (only with strategy replicated).
enum class TracerChoice : std::uint8_t { grid, embree };

/// How the nodes' programs are run, and the machine that is modelled, if any.
struct RunnerOptions {
  RunnerKind kind = RunnerKind::threads;
  std::string machine_name = "ipsc2";     ///< to be modelled: a preset's name or a machine file
  std::uint32_t timeout_seconds = 600;    ///< without news from a rank
  nodes::Idle idle = nodes::Idle::sleep;  ///< what ranks' communicating threads do meanwhile, as far as processors permit
};

/// A strategy and its requirements on the computer.
struct StrategyOptions {
  Strategy strategy = Strategy::svm;
  nodes::ComputerRequest computer;  ///< with the machine, once it is read (apps/run/run_strategy.h)
  RunnerOptions runner;
  svm::PageOptions pages;
  std::string policy_place;                     ///< of --replacement, if it names a policy of the user's
  std::shared_ptr<const ForeignPolicy> policy;  ///< that policy, once it is loaded (apps/run/run_strategy.h)
  dataflow::RayOptions rays = {.topology = nodes::TopologyKind::hypercube};
  TracerChoice tracer = TracerChoice::grid;
  bool has_several_frames = false;  ///< several pictures of the scene are rendered on the same nodes
};

/// Declares --nodes; `standard` describes the default in the help.
void add_nodes_option(OptionSet options, std::uint32_t& count, const std::string& standard);
void add_strategy_option(OptionSet options, Strategy& strategy);
void add_memory_option(OptionSet options, std::optional<std::size_t>& node_memory_bytes);
/// Declares --machine; `when` is the condition shown in its help, such as " (virtual)".
void add_machine_option(OptionSet options, std::string& machine_name, const std::string& when);
/// Declares the options of svm, replicated and forest except --count-pages, as a group. `in_flight_default` replaces the
/// description of the default of --in-flight, which covers every runner.
void add_page_options(OptionSet options, StrategyOptions& strategy, const std::string& in_flight_default = "");
/// Declares the options of dataflow as a group.
void add_ray_options(OptionSet options, dataflow::RayOptions& rays);
/// Declares the options for cutting space into regions.
void add_balance_options(OptionSet options, dataflow::BalanceOptions& balance);
/// Declares the option of a single field.
void add_option(OptionSet options, const core::Field& field, svm::PageOptions& pages);

/// For OptionSet::check_in_the_end(): throws core::UsageError for options declared above, or --count-pages, that are incompatible
/// with the strategy or with each other.
void check_together(const OptionSet& options, const StrategyOptions& strategy);
/// Returns the default database of a strategy: for forest one tree, whose subtrees take up to 4 KiB.
DatabaseOptions usual_database(Strategy strategy);
/// For OptionSet::check_in_the_end(), also of the options declared by add_options(OptionSet, DatabaseOptions&): sets what the
/// strategy needs where no option is given. Throws core::UsageError for a database that the strategy does not accept.
void settle_database(const OptionSet& options, Strategy strategy, DatabaseOptions& database);

}  // namespace dmpc::apps
