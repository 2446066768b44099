// The options of `render`: a scene, a computer, a strategy, and what to look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/command_line.h"
#include "apps/database_options.h"
#include "apps/picture_options.h"
#include "core/traversal.h"
#include "dataflow/balance.h"
#include "nodes/chaos.h"
#include "nodes/machine.h"
#include "nodes/topology.h"
#include "svm/replacement.h"

namespace dmpc::apps {

/// svm: pages travel. replicated: nothing does, every node holds the whole scene. dataflow: rays travel.
enum class Strategy : std::uint8_t { svm, replicated, dataflow };
/// As the command line calls it.
const char* name_of(Strategy strategy);

/// Who finds what a ray hits: our grid, or Embree (with strategy replicated only).
enum class TracerChoice : std::uint8_t { grid, embree };

/// What calls the nodes' programs: threads, by the wall clock, or the model of a machine, in virtual time.
enum class RunnerKind : std::uint8_t { threads, virtual_time };
/// As the command line calls it.
const char* name_of(RunnerKind runner);

/// What every strategy asks of the computer.
struct ComputerOptions {
  std::uint32_t node_count = 8;
  std::optional<std::size_t> node_memory_bytes;  ///< of each node; without it what the strategy needs
  std::optional<nodes::Chaos> chaos;             ///< disturbs the run
  core::TraversalOptions traversal;
  RunnerKind runner = RunnerKind::threads;
  std::string machine_name = "ipsc2";     ///< to be modelled: a preset's name or a machine file
  bool no_contention = false;             ///< on the modelled machine
  std::optional<nodes::Machine> machine;  ///< the model itself, once it is read (run_strategy.h)
};

/// Of svm, and as far as no page travels of replicated; svm/plan.h says more.
struct PageOptions {
  std::optional<std::uint32_t> cache_pages;
  svm::Replacement replacement = svm::Replacement::lru;
  std::optional<std::uint32_t> in_flight;
  std::uint32_t work_item_side = 3;
  bool count_pages = false;
};

/// Of dataflow; dataflow/plan.h says more.
struct RayOptions {
  dataflow::BalanceOptions balance;
  std::optional<std::uint32_t> ray_batch;
  std::optional<std::uint32_t> ray_credits;
  std::optional<std::uint32_t> queue_packets;
  nodes::TopologyKind topology = nodes::TopologyKind::hypercube;  ///< onto which the regions are mapped
};

struct RenderOptions {
  PictureOptions picture;
  DatabaseOptions database;
  Strategy strategy = Strategy::svm;
  ComputerOptions computer;
  PageOptions pages;
  RayOptions rays;
  TracerChoice tracer = TracerChoice::grid;
  std::filesystem::path image;                 ///< where the picture goes
  std::optional<std::filesystem::path> stats;  ///< where the counters go, as JSON
  bool quiet = false;                          ///< no progress and no closing lines
};

/// Declares them, and which go together.
void add_options(OptionSet options, RenderOptions& render);

}  // namespace dmpc::apps
