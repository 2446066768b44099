// What a seed of chaos stands for: a picture, a computer, and the bounds of its nodes, starved or ample.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "core/base/sampling.h"
#include "dataflow/run.h"
#include "nodes/chaos.h"
#include "nodes/machine.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests {

/// One of the small pictures among which a seed chooses: one pixel or hundreds, one page or hundreds, with all that scenes can
/// have.
struct ChaosSubject {
  std::string name;
  std::function<core::Scene()> scene;
  Subject::Size size;
  std::size_t page_size_bytes = 512;
};

/// One triangle under one light, in the middle of nothing.
inline core::Scene one_small_triangle() {
  core::Scene scene;
  scene.name = "one small triangle";
  scene.view = {.from = {0, -3, 1}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle_degrees = 40};
  scene.lights = {{{0.5, -2, 3}}};
  core::SceneBuilder builder(scene);
  builder.material({.color = {1, 0.5, 0.2}, .diffuse = 1});
  builder.polygon({{-0.3, 0, -0.2}, {0.3, 0, -0.2}, {0, 0.1, 0.2}});
  return scene;
}

inline const std::array<ChaosSubject, 16>& chaos_subjects() {
  const auto named = [](const char* name) { return [name] { return built_in(name); }; };
  static const std::array<ChaosSubject, 16> subjects = {{
      {"mirrors and glass", mirrors_and_glass, {16, 16}},
      {"mirrors and glass, refined", mirrors_and_glass, {.width = 12, .height = 9, .samples = 2, .refinement = {.error = 0.03}}},
      {"mirrors and glass, two pixels", mirrors_and_glass, {2, 1}, 65536},
      {"mirrors and glass, a column", mirrors_and_glass, {1, 37}, 1024},
      {"mirrors and glass, cut off", mirrors_and_glass, {.width = 9, .height = 6, .samples = 3, .cutoff = 0.02}, 2048},
      {"everything", everything, {12, 8}},
      {"everything, refined", everything, {.width = 7, .height = 5, .samples = 2, .refinement = {.error = 0.02}}},
      {"everything, background", everything, {.width = 11, .height = 7, .samples = 2, .knows_background = true}, 4096},
      {"a thousand lights", thousand_lights, {3, 2}},
      {"tetra-3", named("tetra-3"), {.width = 19, .height = 13, .knows_background = true}},
      {"tetra-3, refined", named("tetra-3"), {.width = 12, .height = 12, .samples = 2, .refinement = {.error = 0.02}}, 1024},
      {"balls-2", named("balls-2"), {13, 7}, 4096},
      {"rings-1", named("rings-1"), {10, 10}},
      {"teapot-3", named("teapot-3"), {14, 9}},
      {"one small triangle", one_small_triangle, {.width = 21, .height = 5, .knows_background = true}},
      {"one small triangle, one pixel", one_small_triangle, {1, 1}, 65536},
  }};
  return subjects;
}

/// The subject with this number, made when it is first asked for. Not thread-safe.
inline const Subject& chaos_subject(std::size_t number, core::Structure structure = core::Structure::grid) {
  static std::array<std::array<std::unique_ptr<const Subject>, 16>, 3> made;
  const ChaosSubject& wanted = chaos_subjects().at(number);
  std::unique_ptr<const Subject>& subject = made.at(static_cast<std::size_t>(structure)).at(number);
  if (!subject) {
    subject = std::make_unique<const Subject>(
        wanted.scene(), wanted.size, core::BuildOptions{.page_size_bytes = wanted.page_size_bytes, .structure = structure});
  }
  return *subject;
}

/// All draws of a seed, in a fixed order: what all strategies have alike.
class ChaosCase {
 public:
  explicit ChaosCase(std::uint64_t seed, core::Structure structure = core::Structure::grid)
      : seed_(seed),
        structure_(structure),
        draws_(core::mix(seed + 1)),
        subject_(draws_.below(static_cast<std::uint32_t>(chaos_subjects().size()))),
        nodes_(one_of({1U, 2U, 2U, 3U, 3U, 5U, 5U, 8U, 8U, 13U, 17U, 33U, 64U})),
        is_modelled_(draws_.chance(20)),
        is_in_parts_(draws_.chance(20)),
        part_(1 + draws_.below(40)) {}

  std::uint64_t seed() const { return seed_; }
  const Subject& subject() const { return chaos_subject(subject_, structure_); }
  std::size_t subject_number() const { return subject_; }
  std::uint32_t node_count() const { return nodes_; }
  /// Rendered in parts, each of which keeps something and is then stopped.
  bool is_in_parts() const { return is_in_parts_ && !is_modelled_; }
  /// How often light comes in a part until it is kept.
  std::uint32_t part() const { return part_; }

  /// The processes that share the nodes, by a draw of its own.
  std::uint32_t rank_count() const {
    nodes::ChaosStream draws(core::mix(seed_ ^ 0x3a9c5));
    return draws.chance(40) ? 1 : std::min(nodes_, 2 + draws.below(4));
  }

  /// The threads that drive the nodes of each process, or nothing where each node has one, by a draw of its own.
  std::optional<std::uint32_t> pool_threads() const {
    nodes::ChaosStream draws(core::mix(seed_ ^ 0xd21fe));
    return draws.chance(40) ? std::optional(1 + draws.below(4)) : std::nullopt;
  }

  /// Options of svm; replicated and forest have no cache. `round` tells the parts of one picture apart.
  svm::RunOptions page_options(const svm::Strategy* strategy, std::uint32_t round = 0) {
    svm::RunOptions options{.computer = {.node_count = nodes_}};
    options.pages.in_flight = one_of<std::optional<std::uint32_t>>({1, 1, 2, 3, 5, 8, 64, 4096, std::nullopt});
    options.pages.work_item_side = one_of({0U, 1U, 2U, 3U, 3U, 7U, 100U});
    options.pages.worker_count = draws_.chance(30) ? 1 + draws_.below(nodes_) : nodes_;
    options.pages.work_donor =
        options.pages.work_item_side != 0U && draws_.chance(25) ? svm::WorkDonor::host : svm::WorkDonor::ring;
    if (options.pages.work_donor == svm::WorkDonor::ring && draws_.chance(30)) {
      options.pages.pixel_shares = svm::PixelShares::interleaved;
    }
    if (strategy == svm::svm_strategy()) {
      options.pages.cache_pages = one_of<std::optional<std::uint32_t>>({1, 1, 2, 3, 16, std::nullopt});
      options.pages.replacement = one_of({svm::Replacement::lru, svm::Replacement::lru, svm::Replacement::clock,
                                          svm::Replacement::fifo, svm::Replacement::random, svm::Replacement::two_queues,
                                          svm::Replacement::adaptive, svm::Replacement::small_and_main});
      options.pages.homes = one_of({svm::PageHomes::spread, svm::PageHomes::spread, svm::PageHomes::host, svm::PageHomes::tree});
      options.pages.resident_percent = one_of({0U, 0U, 50U, 100U});
      options.pages.count_pages = draws_.chance(10) && !subject().settings().refinement.is_wanted();
    }
    disturb(options, round);
    return options;
  }

  dataflow::RunOptions ray_options(std::uint32_t round = 0) {
    dataflow::RunOptions options{.computer = {.node_count = nodes_}};
    options.rays.ray_batch = one_of<std::optional<std::uint32_t>>({1, 1, 2, 5, 10, 40, std::nullopt});
    options.rays.ray_credits = one_of<std::optional<std::uint32_t>>({0, 1, 1, 2, std::nullopt});
    options.rays.tested_objects = one_of({0U, 0U, 1U, 8U});
    if (draws_.chance(30)) {
      options.rays.ray_credits.reset();
      options.rays.ray_slots = 1 + draws_.below(4);
    }
    options.rays.queue_packets = one_of<std::optional<std::uint32_t>>({0, 1, 2, 7, std::nullopt});
    options.rays.balance = {
        .balance = draws_.chance(50) ? dataflow::Balance::subsampled : dataflow::Balance::equal_size,
        .subsample = 4,
        .bsp = {.order = draws_.chance(75) ? dataflow::CutOrder::longer_axis : dataflow::CutOrder::alternating}};
    scatter(options.rays.balance);
    options.rays.without_backpressure = draws_.chance(20);
    options.rays.topology =
        one_of<std::optional<nodes::TopologyKind>>({std::nullopt, nodes::TopologyKind::hypercube, nodes::TopologyKind::mesh});
    disturb(options, round);
    return options;
  }

  friend std::ostream& operator<<(std::ostream& out, const ChaosCase& one) {
    return out << chaos_subjects().at(one.subject_).name << " on " << one.nodes_ << " nodes, "
               << (one.is_modelled_     ? "modelled"
                   : one.pool_threads() ? "pool"
                                        : "threads")
               << (one.is_in_parts() ? ", in parts" : "") << ", " << one.rank_count() << " ranks";
  }

 private:
  /// Some cases have several regions a node, that stay or move, by draws of their own.
  void scatter(dataflow::BalanceOptions& balance) const {
    nodes::ChaosStream draws(core::mix(seed_ ^ 0x5ca77e2ed));
    if (draws.chance(30)) {
      balance.balance = dataflow::Balance::scattered;
      balance.regions_a_node = 1 + draws.below(16);
    } else if (draws.chance(30)) {
      balance.balance = dataflow::Balance::moving;
      balance.regions_a_node = 2 + draws.below(12);
    }
  }

  template <class T>
  T one_of(std::initializer_list<T> values) {
    return values.begin()[draws_.below(static_cast<std::uint32_t>(values.size()))];
  }

  /// Threads by chaos, modelled machines by their own slowness.
  template <class Options>
  void disturb(Options& options, std::uint32_t round) {
    if (!is_modelled_) {
      options.computer.chaos = nodes::chaos_of(core::mix(seed_) + round);
      options.computer.pool_threads = pool_threads();
      return;
    }
    nodes::Machine machine{.topology = one_of({nodes::TopologyKind::crossbar, nodes::TopologyKind::mesh,
                                               nodes::TopologyKind::hypercube, nodes::TopologyKind::fat_tree})};
    for (nodes::MessageCost* const cost : {&machine.short_message, &machine.long_message}) {
      *cost = {.send_ns = draws_.below(100'000),
               .latency_ns = draws_.below(1'000'000),
               .receive_ns = draws_.below(100'000),
               .byte_ps = draws_.below(1'000'000)};
    }
    for (std::uint64_t& cost_ps : machine.cost_ps) {
      cost_ps = draws_.below(100'000'000);
    }
    machine.uplinks = machine.topology == nodes::TopologyKind::fat_tree ? 1 + draws_.below(nodes::Topology::uplinks_max) : 1;
    machine.switching = one_of({nodes::Switching::circuit, nodes::Switching::packet});
    machine.has_contention = draws_.chance(50);
    machine.has_memory_port = draws_.chance(30);
    options.computer.machine = machine;
  }

  std::uint64_t seed_;
  core::Structure structure_;
  nodes::ChaosStream draws_;
  std::size_t subject_;
  std::uint32_t nodes_;
  bool is_modelled_, is_in_parts_;
  std::uint32_t part_;
};

}  // namespace dmpc::tests
