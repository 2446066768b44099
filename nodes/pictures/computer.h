// The emulated computer rendering pictures of one scene, one after another, by any strategy.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "core/base/counts.h"
#include "core/base/expect.h"
#include "core/picture/film/film.h"
#include "core/picture/film/partial_picture.h"
#include "core/picture/pixel_task.h"
#include "core/picture/sampling/fine_detail.h"
#include "core/picture/sampling/refinement.h"
#include "nodes/computer_request.h"
#include "nodes/counters.h"
#include "nodes/gathering.h"
#include "nodes/observers/watching.h"
#include "nodes/pictures/host.h"
#include "nodes/ranks/rank_figures.h"
#include "nodes/runner.h"

namespace dmpc::pictures {

/// The interface of node programs for pictures, in addition to Program.
class PictureProgram {
 public:
  /// To be called when the run of a picture has ended and another one follows, of the same size and samples, from another
  /// viewpoint. The node keeps its part of the scene, and its counters go on. `settings` outlive the picture; their header is the
  /// whole database's. Call it only while the program is not running.
  virtual void begin_frame(const core::RenderSettings& settings) = 0;

 protected:
  ~PictureProgram() = default;
};

/// Calls it for the nodes that are here.
void begin_frame(nodes::Runner& runner, std::uint32_t node_count, const core::RenderSettings& settings);

/// The outcome of a run by any strategy.
struct Outcome {
  core::Film film;
  nodes::RunEnd end = nodes::RunEnd::finished;  ///< interrupted: the film is not complete
  nodes::NodeCounters host = {};
  core::RefinementResult refinement = {};
  std::vector<nodes::RankFigures> ranks = {};                       ///< if there are several, or could be
  std::optional<nodes::VirtualReport> virtual_time = std::nullopt;  ///< on a modelled machine
};

/// An outcome with the reports of its nodes.
template <class NodeReport>
struct Report : Outcome {
  std::vector<NodeReport> nodes = {};

  /// The counters of programs, summed over the nodes.
  template <class Counts, class ProgramReport>
  Counts summed(Counts ProgramReport::*counts) const {
    return core::total_of(nodes, [counts](const NodeReport& node) { return node.program.*counts; });
  }
  /// Packets and bytes sent by all nodes and the host, by kind.
  nodes::TrafficByKind sent() const { return traffic(&nodes::NodeCounters::sent); }
  nodes::TrafficByKind received() const { return traffic(&nodes::NodeCounters::received); }

 private:
  nodes::TrafficByKind traffic(nodes::TrafficByKind nodes::NodeCounters::*way) const {
    nodes::TrafficByKind sum = core::total_of(nodes, [way](const NodeReport& node) { return node.counters.*way; });
    return core::add_counts(sum, host.*way);
  }
};

/// The specifications for a plan if the host is elsewhere. make_program(index, node) makes the program of a node; it is copied.
template <class Plan, class MakeProgram>
std::vector<nodes::NodeSpecification> specifications_without_host(const Plan& plan, const MakeProgram& make_program,
                                                                  const nodes::Batching& batching,
                                                                  std::uint32_t interrupt_kinds = 0) {
  std::vector<nodes::NodeSpecification> all;
  for (std::uint32_t i = 0; i < plan.node_count(); ++i) {
    all.push_back({plan.node_memory(i), plan.node_mailbox, [make_program, i](nodes::Node& node) { return make_program(i, node); },
                   plan.held_bytes, interrupt_kinds, batching});
  }
  all.push_back({plan.host_memory(), plan.host_mailbox, {}, plan.held_bytes});
  return all;
}

/// The settings at the host for the first picture.
template <class PlanRequest>
core::Film film_of(const PlanRequest& request, core::FilmScale scale, const core::PartialPicture* start = nullptr) {
  core::expect(start == nullptr || start->film.pixel_count() == std::size_t{request.width} * request.height,
               "what is gone on with is of the same picture");
  return start != nullptr ? start->film
                          : core::Film(static_cast<int>(request.width), static_cast<int>(request.height), scale,
                                       core::planes_for(request.first_samples));
}

/// Between two pictures the nodes stay as they are, with their parts of scene and picture, and their memories. Not thread-safe.
class Computer {
 public:
  /// specify(film) returns the nodes and the host, which writes that film. What specifications refer to outlives this.
  using Specify = std::function<std::vector<nodes::NodeSpecification>(core::Film& film)>;
  Computer(core::Film film, const Specify& specify, const nodes::ComputerRequest& computer, const nodes::Watching& watching);
  Computer(const Computer&) = delete;
  Computer& operator=(const Computer&) = delete;

  nodes::Runner& runner() { return *runner_; }
  Host& host() { return dynamic_cast<Host&>(runner_->program(node_count_)); }

  /// Begins the next picture, after one that has been completed: `film` is new, of the same size. Other ranks get `settings`.
  /// These and `detail` outlive the picture.
  void begin_frame(core::Film film, const core::RenderSettings& settings, const core::FineDetail* detail);

  /// Runs. gather() gathers the reports of the plan's nodes.
  template <class Plan, class Gather>
  Outcome render(std::stop_token stop, const Plan& plan, const Gather& gather) {
    const nodes::RunEnd end = runner_->run(std::move(stop));
    if (end != nodes::RunEnd::finished) {
      host().keep_interrupted();
    }
    gather();
    return {.film = std::move(film_),
            .end = end,
            .host = runner_->node(node_count_).counters(),
            .refinement = host().refinement().result(),
            .ranks = nodes::gather_rank_figures(*runner_, plan, ranks_, add_seen_),
            .virtual_time = end == nodes::RunEnd::finished ? runner_->virtual_report() : std::nullopt};
  }

 private:
  core::Film film_;
  nodes::RankLinks* ranks_;
  nodes::AddSeen add_seen_;
  std::unique_ptr<nodes::Runner> runner_;
  std::uint32_t node_count_ = 0;  ///< without the host
};

}  // namespace dmpc::pictures
