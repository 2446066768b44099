#include "apps/render_options.h"

#include <bit>
#include <string>

#include "apps/option_values.h"
#include "core/expect.h"
#include "nodes/chaos.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

void set_node_memory(svm::RunOptions& run, const std::string& text) {
  run.node_memory_bytes = text == "auto" ? std::nullopt : std::optional(parse_size_bytes(text, "--node-memory"));
}

void set_page_size(RenderOptions& render, const std::string& text) {
  render.page_size_bytes = parse_size_bytes(text, "--page-size");
  if (!std::has_single_bit(render.page_size_bytes) || render.page_size_bytes < 512 || render.page_size_bytes > 65536) {
    throw UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
}

void add_computer_options(OptionSet& options, RenderOptions& render) {
  svm::RunOptions& run = render.run;
  options.begin_group("The computer");
  options.add_number("--nodes", run.node_count, 1, svm::node_count_max, "8", "Nodes, each with a memory of its own");
  options.add_choice<svm::Strategy>(
      "--strategy", render.strategy, {{"svm", svm::Strategy::svm}, {"replicated", svm::Strategy::replicated}},
      "svm: the scene is spread over the nodes and its pages travel. replicated: every node holds it all");
  options.add_text(
      "--node-memory", "SIZE|auto [auto]", [&run](const std::string& text) { set_node_memory(run, text); },
      "Bound of each node's memory, such as 4MiB");
  options.add_text(
      "--page-size", "SIZE [1KiB]", [&render](const std::string& text) { set_page_size(render, text); },
      "Size of a page, a power of two from 512B to 64KiB");
  options.add_number("--cache-pages", run.cache_pages, 1, 0x7fffffff, "what the memory holds",
                     "Pages of other nodes that a node can keep (svm)");
  options.add_number("--in-flight", run.in_flight, 1, svm::in_flight_max, "16, replicated 1",
                     "Pixels that a node works on at once");
  options.add_number("--work-item", run.work_item_side, 0, 1024, "3",
                     "Side in pixels of what a node gives to an idle one; 0: nothing is given");
}

void add_study_options(OptionSet& options, RenderOptions& render) {
  options.begin_group("Looking closer");
  options.add_choice<TracerChoice>("--tracer", render.tracer, {{"grid", TracerChoice::grid}, {"embree", TracerChoice::embree}},
                                   "Who finds what a ray hits; embree goes with --strategy=replicated only");
  options.add_words(
      "--no-skip", {"empty-space"}, [&render](const std::string&) { render.run.traversal.skip_empty_space = false; },
      "Switch off a short cut that does not change the picture");
  options.add_path("--stats", "FILE.json", render.stats, "Write all counters");
  options.add_flag("--count-pages", render.run.count_pages,
                   "Count the distinct pages of each pixel for --stats (takes memory and time)");
  options.add_text(
      "--chaos", "SEED [calm]",
      [&render](const std::string& text) { render.run.chaos = nodes::chaos_of(parse_seed(text, "--chaos")); },
      "Disturb the computer by this seed: packets late and out of order, slow nodes and links, few credits; the picture stays");
  options.add_flag("--quiet", render.quiet, "No progress, no closing lines");
}

void check_together(const RenderOptions& render) {
  const bool replicated = render.strategy == svm::Strategy::replicated;
  if (render.tracer == TracerChoice::embree && !replicated) {
    throw UsageError("--tracer=embree needs --strategy=replicated: Embree cannot trace through pages that travel");
  }
  if (render.run.cache_pages && replicated) {
    throw UsageError("--cache-pages goes with --strategy=svm: a node of replicated holds all pages and caches none");
  }
  if (render.run.count_pages && replicated) {
    throw UsageError("--count-pages goes with --strategy=svm: replicated looks up no pages");
  }
  if (render.run.count_pages && !render.stats) {
    throw UsageError("--count-pages counts for the --stats file: give --stats=FILE.json too");
  }
}

}  // namespace

void add_options(OptionSet options, RenderOptions& render) {
  add_options(options, render.picture);
  options.add_required(
      "-o,--output", "IMAGE", [&render](const std::string& text) { render.image = text; },
      "The picture: .exr, .tif (linear floats), .png, .jpg (8 bits, sRGB), ...");
  add_computer_options(options, render);
  add_study_options(options, render);
  options.check_in_the_end([&render] { check_together(render); });
  options.set_examples(
      "Examples:\n"
      "  dmpc render teapot-12 --nodes=8 -o teapot.png\n"
      "  dmpc render tetra-10 --nodes=64 --node-memory=4MiB -o tetra.exr\n"
      "  dmpc render rings-4-t1 --cache-pages=16 --count-pages --stats=rings.json -o rings.png\n"
      "  dmpc render my.nff --strategy=replicated --tracer=embree --resolution=1024x768 -o my.tif\n"
      "The picture does not depend on the computer's options, to the last bit: the film_hash of --stats says so.");
}

}  // namespace dmpc::apps
