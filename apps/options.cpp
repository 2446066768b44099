#include "apps/options.h"

#include <CLI/CLI.hpp>
#include <bit>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include "core/expect.h"
#include "core/scenes.h"
#include "nodes/chaos.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

/// An option whose values are words.
template <class T>
void add_choice(CLI::App& app, const std::string& name, T& value, const Choices<T>& choices, const std::string& description) {
  std::string words;
  std::vector<std::string> allowed;
  std::string standard;
  for (const auto& [word, meaning] : choices) {
    words += (words.empty() ? "" : "|") + word;
    allowed.push_back(word);
    standard = meaning == value ? word : standard;
  }
  const auto set = [&value, choices](const std::string& text) {
    for (const auto& [word, meaning] : choices) {
      value = word == text ? meaning : value;
    }
  };
  app.add_option_function<std::string>(name, set, description)
      ->check(CLI::IsMember(allowed))
      ->type_name("")
      ->option_text(words + " [" + standard + "]");
}

/// An option whose values are whole numbers from `least` to `most`; `shown` is what the help says of its default.
template <class T, class Number>
void add_number(CLI::App& app, const std::string& name, T& value, Number least, Number most, const std::string& shown,
                const std::string& description) {
  app.add_option(name, value, description)
      ->check(CLI::Range(least, most))
      ->option_text(std::to_string(least) + ".." + std::to_string(most) + " [" + shown + "]");
}

void add_path(CLI::App& app, const std::string& name, std::optional<std::filesystem::path>& value, const std::string& kind,
              const std::string& description) {
  app.add_option_function<std::string>(
         name, [&value](const std::string& text) { value = text; }, description)
      ->option_text(kind);
}

void add_picture_options(CLI::App& app, PictureOptions& picture) {
  app.add_option("SCENE", picture.scene, "An NFF file, or a built-in scene such as teapot-12, rings-4-t1, tetra-9")
      ->required()
      ->option_text(" ");
  app.add_option_function<std::string>(
         "--resolution", [&picture](const std::string& text) { picture.resolution = parse_resolution(text); },
         "Pixels of the picture")
      ->option_text("WxH [the scene's]");
  add_number(app, "--samples", picture.samples, 1, 32768, "1", "Rays through each pixel");
  add_number(app, "--depth", picture.depth, 1, 255, "5",
             "Longest chain of reflections and refractions; 1 is the eye's ray alone");
  add_choice<core::Convention>(app, "--convention", picture.convention,
                               {{"haines", core::Convention::haines}, {"paper", core::Convention::paper}},
                               "When shadow rays are cast: towards lights that the surface faces, or towards all");
}

void set_node_memory(svm::RunOptions& run, const std::string& text) {
  run.node_memory_bytes = text == "auto" ? std::nullopt : std::optional(parse_size_bytes(text, "--node-memory"));
}

void set_page_size(RenderOptions& options, const std::string& text) {
  options.page_size_bytes = parse_size_bytes(text, "--page-size");
  if (!std::has_single_bit(options.page_size_bytes) || options.page_size_bytes < 512 || options.page_size_bytes > 65536) {
    throw UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
}

void add_computer_options(CLI::App& app, RenderOptions& options) {
  svm::RunOptions& run = options.run;
  app.option_defaults()->group("The computer");
  add_number(app, "--nodes", run.node_count, 1U, svm::node_count_max, "8", "Nodes, each with a memory of its own");
  add_choice<svm::Strategy>(app, "--strategy", options.strategy,
                            {{"svm", svm::Strategy::svm}, {"replicated", svm::Strategy::replicated}},
                            "svm: the scene is spread over the nodes and its pages travel. replicated: every node holds it all");
  app.add_option_function<std::string>(
         "--node-memory", [&run](const std::string& text) { set_node_memory(run, text); },
         "Bound of each node's memory, such as 4MiB")
      ->option_text("SIZE|auto [auto]");
  app.add_option_function<std::string>(
         "--page-size", [&options](const std::string& text) { set_page_size(options, text); },
         "Size of a page, a power of two from 512B to 64KiB")
      ->option_text("SIZE [1KiB]");
  add_number(app, "--cache-pages", run.cache_pages, 1U, 0x7fffffffU, "what the memory holds",
             "Pages of other nodes that a node can keep (svm)");
  add_number(app, "--in-flight", run.in_flight, 1U, svm::in_flight_max, "16, replicated 1",
             "Pixels that a node works on at once");
  add_number(app, "--work-item", run.work_item_side, 0U, 1024U, "3",
             "Side in pixels of what a node gives to an idle one; 0: nothing is given");
}

/// CLI11 takes -1 and numbers that are too large for a seed.
std::uint64_t parse_seed(const std::string& text, const std::string& option) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, seed);
  if (error != std::errc() || rest != end) {
    throw UsageError(option + "=" + text + ": expected a whole number from 0 to 18446744073709551615");
  }
  return seed;
}

void add_study_options(CLI::App& app, RenderOptions& options) {
  app.option_defaults()->group("Looking closer");
  add_choice<TracerChoice>(app, "--tracer", options.tracer, {{"grid", TracerChoice::grid}, {"embree", TracerChoice::embree}},
                           "Who finds what a ray hits; embree goes with --strategy=replicated only");
  app.add_option_function<std::vector<std::string>>(
         "--no-skip", [&options](const std::vector<std::string>&) { options.run.traversal.skip_empty_space = false; },
         "Switch off a short cut that does not change the picture")
      ->check(CLI::IsMember({"empty-space"}))
      ->type_name("")
      ->option_text("empty-space");
  add_path(app, "--stats", options.stats, "FILE.json", "Write all counters");
  app.add_flag("--count-pages", options.run.count_pages,
               "Count the distinct pages of each pixel for --stats (takes memory and time)");
  app.add_option_function<std::string>(
         "--chaos", [&options](const std::string& text) { options.run.chaos = nodes::chaos_of(parse_seed(text, "--chaos")); },
         "Disturb the computer by this seed: packets late and out of order, slow nodes and links, few credits; the picture stays")
      ->option_text("SEED [calm]");
  app.add_flag("--quiet", options.quiet, "No progress, no closing lines");
}

void check_together(const RenderOptions& options) {
  const bool replicated = options.strategy == svm::Strategy::replicated;
  if (options.tracer == TracerChoice::embree && !replicated) {
    throw UsageError("--tracer=embree needs --strategy=replicated: Embree cannot trace through pages that travel");
  }
  if (options.run.cache_pages && replicated) {
    throw UsageError("--cache-pages goes with --strategy=svm: a node of replicated holds all pages and caches none");
  }
  if (options.run.count_pages && replicated) {
    throw UsageError("--count-pages goes with --strategy=svm: replicated looks up no pages");
  }
  if (options.run.count_pages && !options.stats) {
    throw UsageError("--count-pages counts for the --stats file: give --stats=FILE.json too");
  }
}

CLI::App* add_render(CLI::App& app, RenderOptions& options) {
  CLI::App* render = app.add_subcommand("render", "Render a scene on N nodes");
  add_picture_options(*render, options.picture);
  render
      ->add_option_function<std::string>(
          "-o,--output", [&options](const std::string& text) { options.image = text; },
          "The picture: .exr, .tif (linear floats), .png, .jpg (8 bits, sRGB), ...")
      ->required()
      ->option_text("IMAGE");
  add_computer_options(*render, options);
  add_study_options(*render, options);
  render->final_callback([&options] { check_together(options); });
  render->footer(
      "Examples:\n"
      "  dmpc render teapot-12 --nodes=8 -o teapot.png\n"
      "  dmpc render tetra-10 --nodes=64 --node-memory=4MiB -o tetra.exr\n"
      "  dmpc render rings-4-t1 --cache-pages=16 --count-pages --stats=rings.json -o rings.png\n"
      "  dmpc render my.nff --strategy=replicated --tracer=embree --resolution=1024x768 -o my.tif\n"
      "The picture does not depend on the computer's options, to the last bit: the film_hash of --stats says so.");
  return render;
}

CLI::App* add_scene(CLI::App& app, SceneOptions& options) {
  CLI::App* scene = app.add_subcommand("scene", "Write a built-in scene as an NFF file");
  scene->add_option("NAME", options.name, "FAMILY, FAMILY-SIZE, or FAMILY-SIZE-tN for curved surfaces as triangles")
      ->required()
      ->option_text(" ");
  add_path(*scene, "-o,--output", options.output, "FILE.nff [stdout]", "Where it goes");
  scene->footer("Families:\n" + core::describe_scene_families() +
                "\nExamples:\n"
                "  dmpc scene teapot-12 -o teapot.nff\n"
                "  dmpc scene rings-4-t1 | head");
  return scene;
}

CLI::App* add_check(CLI::App& app, CheckOptions& options) {
  CLI::App* check =
      app.add_subcommand("check", "Trace every ray of a render with Embree too, and let a referee settle differences");
  add_picture_options(*check, options.picture);
  add_number(*check, "--list", options.list, 0U, 1000000U, "10", "Differences to print in full");
  add_number(*check, "--brute-force", options.brute_force, std::uint64_t{0}, std::uint64_t{1} << 40U, "0",
             "Rays that are tested against every primitive in double precision, too");
  check->footer(
      "Examples:\n"
      "  dmpc check teapot-12\n"
      "  dmpc check tetra-9 --resolution=128x128 --brute-force=1000\n"
      "Exit status 3 says that a difference stays unexplained.");
  return check;
}

CLI::App* add_compare(CLI::App& app, CompareOptions& options) {
  CLI::App* compare = app.add_subcommand("compare", "Measure how far two pictures lie apart");
  const auto add_picture = [&](const char* name, std::filesystem::path& path, const char* description) {
    compare
        ->add_option_function<std::string>(
            name, [&path](const std::string& text) { path = text; }, description)
        ->required()
        ->option_text(" ");
  };
  add_picture("A", options.picture, "A picture");
  add_picture("B", options.reference, "Another of the same size, the reference");
  add_path(*compare, "--difference", options.difference, "IMAGE", "Write the absolute differences as a picture");
  compare->footer(
      "Example:\n"
      "  dmpc compare draft.exr final.exr --difference=error.png");
  return compare;
}

/// "dmpc render --help", or plain if no command was understood.
std::string hint(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  const std::string command = commands.empty() ? "" : commands.front()->get_name() + " ";
  return "\nTry: dmpc " + command + "--help";
}

/// CLI11 would only say that a command is missing.
void check_command_name(const CLI::App& app, std::span<const std::string> arguments) {
  if (arguments.empty() || arguments.front().rfind('-', 0) == 0) {
    return;
  }
  const auto named = [&](const CLI::App* command) { return command->get_name() == arguments.front(); };
  if (app.get_subcommands(named).empty()) {
    throw UsageError(arguments.front() + " is no command: expected render, scene, check or compare" + hint(app));
  }
}

/// Parses into the structs that the options of `app` point at; returns help if that was asked for.
std::optional<HelpText> parse(CLI::App& app, std::span<const std::string> arguments) {
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them from the back
    return std::nullopt;
  } catch (const CLI::Success& asked) {
    std::ostringstream output, errors;
    app.exit(asked, output, errors);
    return HelpText{output.str()};
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what() + hint(app));
  } catch (const UsageError& error) {
    throw UsageError(error.what() + hint(app));
  }
}

}  // namespace

Command parse_command_line(std::span<const std::string> arguments) {
  CLI::App app("dmpc: a distributed-memory parallel computer on one machine, for ray tracing", "dmpc");
  app.set_version_flag("--version", "dmpc " DMPC_VERSION, "Print the version");
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  app.footer("dmpc COMMAND --help says more, with examples.\nStart with: dmpc render teapot-12 --nodes=8 -o teapot.png");
  RenderOptions render;
  SceneOptions scene;
  CheckOptions check;
  CompareOptions compare;
  const CLI::App* const is_render = add_render(app, render);
  const CLI::App* const is_scene = add_scene(app, scene);
  const CLI::App* const is_check = add_check(app, check);
  add_compare(app, compare);
  check_command_name(app, arguments);
  if (std::optional<HelpText> help = parse(app, arguments)) {
    return std::move(*help);
  }
  if (is_render->parsed()) {
    return render;
  }
  if (is_scene->parsed()) {
    return scene;
  }
  return is_check->parsed() ? Command(check) : Command(compare);
}

std::size_t parse_size_bytes(std::string_view text, std::string_view option) {
  std::uint64_t count = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const std::string_view unit(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
  const Choices<int> units = {{"", 0}, {"B", 0}, {"KiB", 10}, {"MiB", 20}, {"GiB", 30}};
  constexpr std::uint64_t bytes_max = std::uint64_t{1} << 40U;
  for (const auto& [name, shift] : units) {
    if (error == std::errc() && name == unit && count <= bytes_max >> shift) {
      return static_cast<std::size_t>(count << shift);
    }
  }
  throw UsageError(std::string(option) + "=" + std::string(text) + ": expected a size such as 4096B, 300KiB, 4MiB or 1GiB");
}

Resolution parse_resolution(std::string_view text) {
  Resolution size;
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    const auto pixels = std::int64_t{size.width} * size.height;
    if (height.ec == std::errc() && height.ptr == end && size.width >= 1 && size.height >= 1 && size.width <= 65536 &&
        size.height <= 65536 && pixels <= picture_pixels_max) {
      return size;
    }
  }
  throw UsageError("--resolution=" + std::string(text) +
                   ": expected WIDTHxHEIGHT such as 512x384, each 1 to 65536 and at most 268435456 pixels in all");
}

}  // namespace dmpc::apps
