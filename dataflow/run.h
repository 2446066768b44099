// Renders a picture on N nodes with travelling rays: assigns the scene, plans the memory, runs, and reports.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/database/database.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "core/trace/traversal.h"
#include "dataflow/distribution.h"
#include "dataflow/host.h"
#include "dataflow/plan.h"
#include "dataflow/program.h"
#include "dataflow/ray_options.h"
#include "dataflow/regions/mapping.h"
#include "dataflow/regions/regions.h"
#include "nodes/computer_request.h"
#include "nodes/gathering.h"
#include "nodes/observers/watching.h"
#include "nodes/pictures/computer.h"
#include "nodes/runner.h"

namespace dmpc::dataflow {

/// Options of a run, without the database and the picture.
struct RunOptions {
  nodes::ComputerRequest computer = {};
  RayOptions rays = {};
  MakeRegions make_regions = {};  ///< user-defined regions, in place of those given by `rays`
  nodes::Watching watching = {};  ///< rays look up no pages: those kinds of a heat map stay zero
  /// Where the picture is begun, and what of it is saved during the run: in states that the host reaches by assigning no more
  /// primary rays until none is left. So with any of it the host assigns all of them after the start.
  core::Continuation continuation = {};
  /// Several pictures follow each other (dataflow/frames.h): then, too, the host assigns all primary rays after the start.
  bool are_frames = false;
};

struct NodeReport : nodes::NodeFigures {
  ProgramReport program;
  core::Region region;  ///< the box around its regions, in finest cells
  std::uint32_t region_count = 1;
  double region_share = 0;             ///< share of the grid's volume in them
  std::size_t part_bytes = 0;          ///< the records of its regions
  std::uint64_t primitive_copies = 0;  ///< in these records
  std::uint64_t primary_rays = 0;      ///< assigned before the start
};

struct Report : pictures::Report<NodeReport> {
  std::uint64_t samples_found_done = 0;  ///< all pixels' samples that were done before the start
  Plan plan;
  Regions regions;
  std::vector<double> predicted;  ///< load by node, in picoseconds of the subsampled picture; empty without one
  double duplication = 1;         ///< copies of primitives over those in the database
  HostCounters host_rays = {};

  core::Operations operations() const { return summed(&ProgramReport::operations); }
  RayCounters rays() const { return summed(&ProgramReport::rays); }
  MovementCounters movement() const { return summed(&ProgramReport::movement); }
  Gather::Counters gathers() const;
  /// The work that each node has done, in picoseconds by measured_prices: to be compared with `predicted`.
  std::vector<double> work() const;
  /// Rays from a node (row) to an owner (column), by either way, row by row.
  std::vector<std::uint64_t> ray_matrix() const;
  /// The pairs with rays only, in the same order: few, if there are many nodes.
  std::vector<Flow> ray_flows() const;
  /// Ray messages per ray: how often a ray changes its node, on average.
  double messages_per_ray() const;
  /// Mean rays in a packet over those in a full one, in (0, 1]; 1 without packets.
  double mean_fill() const;
};

/// The part of this traffic that is packets with rays, by either way: those through the host count twice.
nodes::Traffic ray_traffic(const nodes::TrafficByKind& by_kind);

/// The result of the preparations for a run.
struct Prepared {
  Distribution distribution;      ///< regions on their nodes, and the assignments
  std::vector<double> predicted;  ///< as in Report
  double duplication = 1;         ///< as in Report
  core::FineDetail detail;        ///< the picture's, if it is refined
  Plan plan;
};

/// Balances, assigns and plans. Takes about as long as rendering the subsampled picture. Throws as make_plan() does. After a stop
/// is requested it ends early, and its result is only good for a run that the same stop ends at once.
Prepared prepare(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                 const std::stop_token& stop = {});

/// The arguments of make_plan() for nodes with these shares.
PlanRequest plan_request(std::vector<Share> shares, const core::RenderSettings& settings, const RunOptions& options);

/// Renders the result of prepare() with the same settings and options. On ranks rank 0 calls it, and the others follow()
/// (dataflow/ranks.h). Throws core::InternalError if a conservation law is broken. Concurrent calls are independent.
Report run_prepared(const Prepared& prepared, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop);

/// Renders with strategy dataflow: prepares and runs, and throws as these do.
Report run_dataflow(const core::Database& database, const core::RenderSettings& settings, const RunOptions& options,
                    std::stop_token stop);

/// Makes the program of node `index`; called before the start, in order, on the calling thread.
using MakeProgram = std::function<std::unique_ptr<NodeProgram>(std::uint32_t index, nodes::Node& node)>;

/// The specifications for `plan`: the nodes in order, then the host, which writes `film`. All arguments outlive the runner. Of
/// `options` it uses those for meters. `stop`: the run's.
std::vector<nodes::NodeSpecification> specifications_of(const Plan& plan, const Distribution& distribution,
                                                        const core::RenderSettings& settings, core::Film& film,
                                                        const RunOptions& options, const std::stop_token& stop = {},
                                                        const core::FineDetail* detail = nullptr);

/// The specifications if the host is elsewhere.
std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program);

/// The reports after a run.
struct GatheredReports {
  std::vector<NodeReport> nodes;  ///< as far as their programs know
  bool are_credits_back = true;   ///< where they started
};
/// To be called after a run, on all ranks: the reports of all nodes on the host's rank; on others those of their own nodes.
GatheredReports gather_reports(nodes::Runner& runner, const Plan& plan);

}  // namespace dmpc::dataflow
