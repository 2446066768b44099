#include "apps/render_options.h"

#include <algorithm>
#include <string>
#include <vector>

#include "apps/machines.h"
#include "apps/option_values.h"
#include "apps/region_options.h"
#include "core/expect.h"
#include "dataflow/packets.h"
#include "dataflow/plan.h"
#include "svm/plan.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

void set_node_memory(ComputerOptions& computer, const std::string& text) {
  computer.node_memory_bytes = text == "auto" ? std::nullopt : std::optional(parse_size_bytes(text, "--node-memory"));
}

void add_computer_options(OptionSet& options, RenderOptions& render) {
  ComputerOptions& computer = render.computer;
  options.begin_group("The computer");
  options.add_number("--nodes", computer.node_count, 1, svm::node_count_max, "8",
                     "Nodes, each with a memory of its own; dataflow takes up to " + std::to_string(dataflow::region_count_max));
  options.add_choice<Strategy>(
      "--strategy", render.strategy,
      {{"svm", Strategy::svm}, {"replicated", Strategy::replicated}, {"dataflow", Strategy::dataflow}},
      "svm: the scene is spread over the nodes and its pages travel. replicated: every node holds it all. dataflow: every node "
      "holds a region of space and rays travel");
  options.add_text(
      "--node-memory", "SIZE|auto [auto]", [&computer](const std::string& text) { set_node_memory(computer, text); },
      "Bound of each node's memory, such as 4MiB");
  add_options(options, render.database);
}

void add_runner_options(OptionSet& options, ComputerOptions& computer) {
  options.begin_group("What drives the computer");
  options.add_choice<RunnerKind>(
      "--runner", computer.runner, {{"threads", RunnerKind::threads}, {"virtual", RunnerKind::virtual_time}},
      "threads: a thread for each node. virtual: the model of a machine, in its own time, the same whenever it is repeated");
  options.add_text(
      "--machine", "NAME|FILE.json [ipsc2]", [&computer](const std::string& name) { computer.machine_name = name; },
      "The machine that is modelled (virtual): " + machine_preset_names() + " or a file such as dmpc machine prints");
  options.add_flag("--no-contention", computer.no_contention, "A link carries any number of messages at once (virtual)");
  options.add_text(
      "--chaos", "SEED [calm]",
      [&computer](const std::string& text) { computer.chaos = nodes::chaos_of(parse_seed(text, "--chaos")); },
      "Disturb the computer by this seed (threads): packets late and out of order, slow nodes and links, few credits; the "
      "picture stays");
}

void add_page_options(OptionSet& options, PageOptions& pages) {
  options.begin_group("Strategies svm and replicated");
  options.add_number("--cache-pages", pages.cache_pages, 1, 0x7fffffff, "what the memory holds",
                     "Pages of other nodes that a node can keep (svm)");
  using svm::Replacement;
  options.add_choice<Replacement>(
      "--replacement", pages.replacement,
      {{"lru", Replacement::lru}, {"clock", Replacement::clock}, {"fifo", Replacement::fifo}, {"random", Replacement::random}},
      "Which of them makes room for another (svm)");
  options.add_number("--in-flight", pages.in_flight, 1, svm::in_flight_max, "16, replicated 1, runner virtual 1",
                     "Pixels that a node works on at once");
  options.add_number("--work-item", pages.work_item_side, 0, 1024, "3",
                     "Side in pixels of what a node gives to an idle one; 0: nothing is given");
  options.add_flag("--count-pages", pages.count_pages,
                   "Count the distinct pages of each pixel for --stats (svm; takes memory and time)");
}

void add_ray_options(OptionSet& options, RayOptions& rays) {
  using dataflow::Balance;
  options.begin_group("Strategy dataflow");
  options.add_choice<Balance>("--balance", rays.balance.balance,
                              {{"subsampled", Balance::subsampled}, {"equal-size", Balance::equal_size}},
                              "Regions of about equal load, by a subsampled picture, or of equal size");
  add_region_options(options, rays.balance, rays.topology);
  options.add_number("--ray-batch", rays.ray_batch, 1, dataflow::ray_batch_max, "what fills 1 KiB", "Rays in a packet, at most");
  options.add_number("--ray-credits", rays.ray_credits, 0, dataflow::ray_credits_max, "4",
                     "Packets of rays that each node may have under way to each other; 0: all go by way of the host");
  options.add_number("--ray-queue", rays.queue_packets, 0, dataflow::queue_packets_max, "512",
                     "Packets of rays that can wait on a node for credit before more go by way of the host");
}

void add_study_options(OptionSet& options, RenderOptions& render) {
  options.begin_group("Looking closer");
  options.add_choice<TracerChoice>("--tracer", render.tracer, {{"grid", TracerChoice::grid}, {"embree", TracerChoice::embree}},
                                   "Who finds what a ray hits; embree goes with --strategy=replicated only");
  options.add_words(
      "--no-skip", {"empty-space"}, [&render](const std::string&) { render.computer.traversal.skip_empty_space = false; },
      "Switch off a short cut that does not change the picture");
  options.add_path("--stats", "FILE.json", render.stats, "Write all counters");
  options.add_flag("--quiet", render.quiet, "No progress, no closing lines");
}

/// An option that only some strategies have, and why.
struct Belonging {
  const char* option;
  std::vector<Strategy> strategies;
  const char* reason;

  bool has(Strategy strategy) const { return std::find(strategies.begin(), strategies.end(), strategy) != strategies.end(); }
  std::string names() const {
    std::string names;
    for (const Strategy strategy : strategies) {
      names += std::string(names.empty() ? "" : " or ") + "--strategy=" + name_of(strategy);
    }
    return names;
  }
};

const std::vector<Belonging>& belongings() {
  static const std::vector<Belonging> all = {
      {"--cache-pages", {Strategy::svm}, "a node of the others needs no page of another node"},
      {"--replacement", {Strategy::svm}, "a node of the others keeps no page of another node"},
      {"--count-pages", {Strategy::svm}, "the others look up no pages"},
      {"--in-flight", {Strategy::svm, Strategy::replicated}, "a node of dataflow traces one ray at a time"},
      {"--work-item", {Strategy::svm, Strategy::replicated}, "a node of dataflow works on what comes to its region"},
      {"--balance", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--subsample", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--balance-grid", {Strategy::dataflow}, "the others share out pixels, not space"},
      {"--ray-batch", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--ray-credits", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--ray-queue", {Strategy::dataflow}, "rays of the others do not travel"},
      {"--topology", {Strategy::dataflow}, "the others map no regions onto nodes"},
  };
  return all;
}

void check_strategy(const OptionSet& options, const RenderOptions& render) {
  for (const Belonging& belonging : belongings()) {
    if (options.is_given(belonging.option) && !belonging.has(render.strategy)) {
      throw UsageError(std::string(belonging.option) + " goes with " + belonging.names() + ": " + belonging.reason);
    }
  }
  if (render.tracer == TracerChoice::embree && render.strategy != Strategy::replicated) {
    throw UsageError("--tracer=embree needs --strategy=replicated: Embree sees the whole scene, and no other node holds it all");
  }
  if (render.strategy == Strategy::dataflow && render.computer.node_count > dataflow::region_count_max) {
    throw UsageError("--nodes=" + std::to_string(render.computer.node_count) + ": from 1 to " +
                     std::to_string(dataflow::region_count_max) + " nodes with --strategy=dataflow");
  }
}

/// An option that does not go with one of the runners, and why.
struct Conflict {
  const char* option;
  RunnerKind runner;
  const char* reason;
};

constexpr Conflict conflicts[] = {
    {"--machine", RunnerKind::threads, "threads model no machine"},
    {"--no-contention", RunnerKind::threads, "threads model no links"},
    {"--chaos", RunnerKind::virtual_time, "chaos disturbs threads only"},
    {"--topology", RunnerKind::virtual_time, "the machine has a topology of its own, onto which regions are mapped"},
};

void check_runner(const OptionSet& options, const RenderOptions& render) {
  const RunnerKind runner = render.computer.runner;
  for (const Conflict& conflict : conflicts) {
    if (options.is_given(conflict.option) && conflict.runner == runner) {
      throw UsageError(std::string(conflict.option) + " does not go with --runner=" + name_of(runner) + ": " + conflict.reason);
    }
  }
  if (render.tracer == TracerChoice::embree && runner == RunnerKind::virtual_time) {
    throw UsageError("--tracer=embree does not go with --runner=virtual: nobody knows what Embree's operations would cost");
  }
}

void check_together(const OptionSet& options, const RenderOptions& render) {
  check_strategy(options, render);
  check_runner(options, render);
  if (render.pages.count_pages && !render.stats) {
    throw UsageError("--count-pages counts for the --stats file: give --stats=FILE.json too");
  }
  for (const char* const option : {"--subsample", "--balance-grid"}) {
    if (options.is_given(option) && render.rays.balance.balance == dataflow::Balance::equal_size) {
      throw UsageError(std::string(option) + " goes with --balance=subsampled: regions of equal size ask for no load");
    }
  }
}

}  // namespace

const char* name_of(Strategy strategy) {
  switch (strategy) {
    case Strategy::svm:
      return "svm";
    case Strategy::replicated:
      return "replicated";
    case Strategy::dataflow:
      return "dataflow";
  }
  core::expect(false, "a strategy has a name");
  return "";
}

const char* name_of(RunnerKind runner) { return runner == RunnerKind::threads ? "threads" : "virtual"; }

void add_options(OptionSet options, RenderOptions& render) {
  add_options(options, render.picture);
  options.add_required(
      "-o,--output", "IMAGE", [&render](const std::string& text) { render.image = text; },
      "The picture: .exr, .tif (linear floats), .png, .jpg (8 bits, sRGB), ...");
  add_computer_options(options, render);
  add_runner_options(options, render.computer);
  add_page_options(options, render.pages);
  add_ray_options(options, render.rays);
  add_study_options(options, render);
  options.check_in_the_end([options, &render] { check_together(options, render); });
  options.set_examples(
      "Examples:\n"
      "  dmpc render teapot-12 --nodes=8 -o teapot.png\n"
      "  dmpc render tetra-10 --nodes=64 --node-memory=4MiB -o tetra.exr\n"
      "  dmpc render rings-4-t1 --cache-pages=16 --count-pages --stats=rings.json -o rings.png\n"
      "  dmpc render rings-3-t1 --strategy=dataflow --nodes=16 --grid-axes=screen -o rings.png\n"
      "  dmpc render teapot-12 --nodes=64 --runner=virtual --machine=ipsc860 --stats=teapot.json -o teapot.png\n"
      "  dmpc render my.nff --strategy=replicated --tracer=embree --resolution=1024x768 -o my.tif\n"
      "The picture does not depend on the computer's options, to the last bit: the film_hash of --stats says so. Only\n"
      "--grid-axes=screen, another grid, rounds otherwise than --grid-axes=world.");
}

}  // namespace dmpc::apps
