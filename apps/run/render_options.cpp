#include "apps/run/render_options.h"

#include <algorithm>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/table/table_options.h"
#include "apps/run/instance_options.h"
#include "core/base/expect.h"
#include "core/picture/heat_kind.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

void add_computer_options(OptionSet& options, RenderOptions& render) {
  nodes::ComputerRequest& computer = render.computer;
  options.begin_group("The computer");
  add_nodes_option(options, computer.node_count, "8; with --runner=mpi the processors of all ranks, less one each");
  add_strategy_option(options, render.strategy);
  add_system_option(options, render.system);
  add_memory_option(options, computer.node_memory_bytes);
  add_options(options, render.database);
  add_instance_option(options, render.database);
}

void add_runner_options(OptionSet& options, RenderOptions& render) {
  options.begin_group("Running the computer");
  options.add_choice<RunnerKind>(
      "--runner", render.runner.kind,
      {{"threads", RunnerKind::threads},
       {"pool", RunnerKind::pool},
       {"virtual", RunnerKind::virtual_time},
       {"mpi", RunnerKind::mpi}},
      "threads: one thread per node. pool: a few threads run all nodes in turn and share one copy of each page, which takes less "
      "processor time if nodes outnumber processors. virtual: a model of a machine with its own time, the same in every run. "
      "mpi: threads of all processes that mpirun or srun started; rank 0 reads, prints and writes");
  options.add_number("--pool-threads", render.computer.pool_threads, 1, nodes::node_count_max, "as many as processors; mpi none",
                     "Threads that run all nodes of a process in turn (pool; with mpi in place of one thread per node)");
  options.add_number("--rank-timeout", render.runner.timeout_seconds, 1, 86400, "600",
                     "Seconds to wait for a rank that hangs and sends nothing; a note is printed every 30 seconds (mpi). If a "
                     "process ends, all end at once");
  add_machine_option(options, render.runner.machine_name, " (virtual)");
  options.add_text(
      "--chaos", "SEED [calm]",
      [&render](const std::string& text) { render.computer.chaos = nodes::chaos_of(parse_seed(text, "--chaos")); },
      "Disturb the computer with this seed (threads): late and reordered packets, slow nodes and links, few credits; the picture "
      "stays the same");
}

void add_study_options(OptionSet& options, RenderOptions& render) {
  options.begin_group("Diagnostics");
  options.add_choice<TracerChoice>("--tracer", render.tracer, {{"grid", TracerChoice::grid}, {"embree", TracerChoice::embree}},
                                   "Ray tracer that finds what a ray hits; embree goes with --strategy=replicated only");
  options.add_path("--stats", "FILE.json", render.stats, "Write all counters; stats.schema.json describes them");
  add_report_option(options, render.report, "with the picture, requested heat maps, counters, losses, traffic and memory");
  add_heat_option(options, render.heat_maps);
  add_layer_option(options, render.layers);
  add_options(options, render.trace);
  options.add_path(
      "--references", "FILE.csv", render.references,
      "Write every node's references to remote pages, in order, for dmpc study references (svm; each takes 4 bytes of the real "
      "computer during the run). They hold for caches of all sizes if --work-item=0 --in-flight=1 fixes their order");
  options.add_flag_with_text("--serve", "0", render.serve_port,
                             "Serve a page that shows the picture as it is rendered, and on modelled machines or with --report "
                             "what the nodes do, to browsers on this computer that know its address, which is printed. At the "
                             "end it shows the page of --report, if there is one. --serve=PORT uses this port");
  options.add_flag("--quiet", render.quiet, "Print no progress and no closing lines");
}

/// The options that a beginner looks for.
void set_brief_help(OptionSet options) {
  options.set_brief_help(
      {{"The picture",
        {{"-o,--output IMAGE", "The picture: .exr, .tif, .png, .jpg, ..."},
         {"--resolution WxH", "Its width and height in pixels"},
         {"--camera FROM/AT", "Position and target of the camera, such as 1,2,3/0,0,0"},
         {"--quality draft|good", "Smooth edges, by adaptive sampling"},
         {"--samples N", "Samples per pixel; auto: as many as --error requires"},
         {"--transport whitted|paths", "Mirrors and hard shadows, or path tracing"},
         {"--sky COLOUR|FILE", "Light from all around, with --transport=paths"}}},
       {"The computer",
        {{"--nodes N", "Number of nodes, each with its own memory [8]"},
         {"--strategy NAME", "What travels: svm (pages), dataflow (rays), forest (questions), replicated (nothing)"},
         {"--system NAME", "One of the published systems: dmpc list systems"},
         {"--node-memory SIZE", "Limit of each node's memory, such as 4MiB"},
         {"--cache-pages N", "Pages of other nodes that a node can cache (svm)"},
         {"--page-size SIZE", "From 512B to 64KiB [1KiB]"}}},
       {"The run",
        {{"--runner NAME", "threads, pool (a few threads for all nodes), virtual (a modelled machine), mpi"},
         {"--machine NAME", "The machine that virtual models: dmpc list machines"},
         {"--time SECONDS", "End an adaptive render (--samples=auto, mesh files) at about this time"},
         {"--serve", "Show it in a browser while it is rendered"}}},
       {"What else is written",
        {{"--report FILE.html", "A page with picture, losses, traffic and memory"},
         {"--heatmap KIND:FILE", "What each pixel took: faults, rays, time, ..."},
         {"--aov KIND:FILE", "What denoisers read: albedo, normal, depth, id"},
         {"--stats FILE.json", "All counters"}}}});
}

void check_tracer(const RenderOptions& render) {
  if (render.tracer == TracerChoice::embree && render.strategy != Strategy::replicated) {
    throw UsageError(
        "--tracer=embree needs --strategy=replicated: Embree needs the whole scene, and nodes of other strategies hold parts of "
        "it");
  }
}

/// An option that is incompatible with a runner, and the reason.
struct Conflict {
  const char* option;
  RunnerKind runner;
  const char* reason;
};

constexpr Conflict conflicts[] = {
    {"--machine", RunnerKind::threads, "threads model no machine"},
    {"--pool-threads", RunnerKind::threads, "each node has a thread of its own"},
    {"--machine", RunnerKind::pool, "threads model no machine"},
    {"--chaos", RunnerKind::virtual_time, "chaos disturbs threads only"},
    {"--checkpoint", RunnerKind::virtual_time, "the time of two halves of a run is not the time of a whole run"},
    {"--machine", RunnerKind::mpi, "ranks run on a real machine"},
    {"--pool-threads", RunnerKind::virtual_time, "a model has no threads"},
};

void check_tracer_and_runner(const RenderOptions& render) {
  const RunnerKind runner = render.runner.kind;
  if (render.tracer == TracerChoice::embree && runner == RunnerKind::virtual_time) {
    throw UsageError("--tracer=embree does not go with --runner=virtual: the cost of Embree's operations is not known");
  }
  if (render.tracer == TracerChoice::embree && runner == RunnerKind::mpi) {
    throw UsageError("--tracer=embree does not go with --runner=mpi: Embree needs the whole scene, which only one process has");
  }
}

/// Only svm's pagers reference pages, and only those that record references rather than count pages.
void check_references(const RenderOptions& render) {
  if (!render.references) {
    return;
  }
  if (render.strategy != Strategy::svm) {
    throw UsageError("--references needs --strategy=svm: with --strategy=" + std::string(name_of(render.strategy)) +
                     " no node asks another for pages");
  }
  if (counts_pages(render)) {
    throw UsageError("--references does not go with " +
                     std::string(render.pages.count_pages ? "--count-pages" : "--heatmap=pages") +
                     ": a node that counts the pages of each pixel does not note their order");
  }
  if (render.checkpoint.resumes) {
    throw UsageError("--resume does not go with --references: those of the part that was rendered before would be missing");
  }
}

/// Refuses options that observe a single run, or prevent continuing it.
void check_frames(const OptionSet& options, const RenderOptions& render) {
  if (!render.frames.are_several()) {
    return;
  }
  const std::string alone = ": give it with one of the frames, such as --frames=3..3, which is the same picture";
  for (const char* option : {"--trace", "--report", "--references"}) {
    if (options.is_given(option)) {
      throw UsageError(std::string(option) + " does not go with several frames" + alone);
    }
  }
  if (render.tracer == TracerChoice::embree) {
    throw UsageError("--tracer=embree does not go with several frames" + alone);
  }
}

/// Between two passes a refined picture ends by time, or by their number, which repeats one that ended by time.
void add_end_options(OptionSet options, RenderOptions& render) {
  options.add_text(
      "--time", "SECONDS",
      [&render](const std::string& text) {
        render.seconds_max = parse_within(text, "--time", above_0, 1e9, "seconds, above 0 and at most 1e9");
      },
      "With --samples=auto: end between two passes, nearest to this wall-clock time of rendering, though the error is not "
      "reached. "
      "The closing lines say which error is, and which --passes repeats the picture");
  options.add_number("--passes", render.picture.refinement.passes, 1, core::passes_max, std::to_string(core::passes_max),
                     "With --samples=auto: the most passes");
}

void check_end(const OptionSet& options, const RenderOptions& render) {
  for (const char* option : {"--time", "--passes"}) {
    if (!render.picture.is_refined && options.is_given(option)) {
      throw UsageError(std::string(option) + " goes with --samples=auto");
    }
  }
  if (render.picture.refinement.kind == core::ErrorKind::noise && render.picture.refinement.passes < 2) {
    throw UsageError("--passes=1: by paths expected at least 2, from which the error can be estimated");
  }
}

void check(const OptionSet& options, const RenderOptions& render) {
  check_together(options, render);
  check_tracer(render);
  check_runner(options, render.runner.kind);
  check_tracer_and_runner(render);
  if (options.is_given("--rank-timeout") && render.runner.kind != RunnerKind::mpi) {
    throw UsageError("--rank-timeout goes with --runner=mpi");
  }
  check_heat(render.heat_maps, render.strategy);
  check_layers(render.layers, render.image);
  check_trace(render.trace);
  check_references(render);
  check_frames(options, render);
  check_end(options, render);
  if (render.pages.count_pages && !render.stats) {
    throw UsageError("--count-pages counts for the --stats file: give --stats=FILE.json too");
  }
  if (!render.serve_port.empty() && !number_in<std::uint16_t>(render.serve_port)) {
    throw UsageError("--serve=" + render.serve_port + ": expected a port from 0 (any that is free) to 65,535, such as 8080");
  }
  if (!render.serve_port.empty() && render.pages.bundles_on_machines) {
    throw UsageError("--bundles does not go with --serve, which observes each pixel: rays are then traced one by one");
  }
  if (render.checkpoint.resumes && !render.heat_maps.empty()) {
    throw UsageError("--resume does not go with --heatmap: the part that was rendered before would be missing");
  }
}

}  // namespace

void check_runner(const OptionSet& options, RunnerKind runner) {
  for (const Conflict& conflict : conflicts) {
    if (options.is_given(conflict.option) && conflict.runner == runner) {
      throw UsageError(std::string(conflict.option) + " does not go with --runner=" + name_of(runner) + ": " + conflict.reason);
    }
  }
}

bool counts_pages(const RenderOptions& render) {
  return render.pages.count_pages ||
         std::any_of(render.heat_maps.begin(), render.heat_maps.end(),
                     [](const HeatRequest& request) { return request.kind == core::HeatKind::pages; });
}

void add_options(OptionSet options, RenderOptions& render) {
  render.picture.presents_meshes = true;
  add_options(options, render.picture);
  add_transport_options(options, render.picture);
  options.add_required(
      "-o,--output", "IMAGE", [&render](const std::string& text) { render.image = text; },
      "The picture: .exr, .tif (linear floats), .png, .jpg (8 bits, sRGB), ...");
  add_computer_options(options, render);
  add_runner_options(options, render);
  add_page_options(options, render);
  add_option(options, core::field_of<&svm::PageOptions::count_pages>(), render.pages);
  add_ray_options(options, render.rays);
  add_study_options(options, render);
  add_options(options, render.frames);
  add_options(options, render.checkpoint);
  add_end_options(options, render);
  options.check_in_the_end([options, &render] {
    if (render.system) {
      settle_system(options, *render.system, render, render.database);
    }
    settle_database(options, render.strategy, render.database);
    settle_instances(options, {render.system, render.tracer, render.rays.tested_objects}, render.database,
                     render.picture.scene_setup.mesh);
    render.is_node_count_given = options.is_given("--nodes");
    render.has_several_frames = render.frames.range.has_value();  // a frame by itself, too: its counters are those of a first one
    check(options, render);
    choose_pool(render.runner.kind, render.computer);
  });
  set_brief_help(options);
  options.set_examples(
      "Examples:\n"
      "  dmpc render teapot-12 --nodes=8 -o teapot.png\n"
      "  dmpc render tetra-10 --nodes=64 --node-memory=4MiB -o tetra.exr\n"
      "  dmpc render rings-4-t1 --cache-pages=16 --count-pages --stats=rings.json -o rings.png\n"
      "  dmpc render rings-4-t1 --heatmap=faults:faults.png --heatmap=faults:faults.exr -o rings.png\n"
      "  dmpc render rings-4-t1 --samples=16 --aov=albedo,normal,depth -o rings.exr\n"
      "  dmpc render rings-4-t1 --runner=virtual --machine=hdr --heatmap=done:when.png -o rings.png\n"
      "  dmpc render rings-4-t1 --nodes=4 --cache-pages=64 --trace=rings.pftrace --trace-window=10,12 -o rings.png\n"
      "  dmpc render rings-4-t1 --cache-pages=64 --heatmap=faults:faults.png --report=rings.html -o rings.png\n"
      "  dmpc render rings-4-t1 --work-item=0 --in-flight=1 --references=rings.csv -o rings.png\n"
      "  dmpc render rings-3-t1 --strategy=dataflow --nodes=16 -o rings.png\n"
      "  dmpc render teapot-12 --nodes=64 --runner=pool -o teapot.png\n"
      "  dmpc render balls-4 --transport=paths --sky=0.4/0.1,0.2,0.8 --samples=auto -o balls.png\n"
      "  dmpc render teapot-12 --transport=paths --light-radius=0.5 --samples=64 -o teapot.png\n"
      "  dmpc render teapot-12 --nodes=64 --runner=virtual --machine=ipsc860 --stats=teapot.json -o teapot.png\n"
      "  mpirun -n 4 dmpc render tetra-10 --runner=mpi --nodes=28 -o tetra.exr\n"
      "  dmpc render rings-4-t1 --frames=90 --turntable=1 -o rings.####.png\n"
      "  dmpc render walk.gltf --frames=48 --animation=walk -o walk.####.png\n"
      "  dmpc render balls-6 --samples=256 --checkpoint=balls.checkpoint --resume -o balls.exr\n"
      "  dmpc render my.nff --strategy=replicated --tracer=embree --resolution=1024x768 -o my.tif\n"
      "The computer's options do not change the picture, to the last bit: compare film_hash in --stats.");
}

}  // namespace dmpc::apps
