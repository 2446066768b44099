// A small program for tests of what is written about programs.
#pragma once

#include <string>

#include "apps/frontend/line/command_line.h"

namespace dmpc::tests {

/// Declares `paint PICTURE`, `mix oil` and `mix water`; what is set is of no interest.
struct Painter {
  Painter() : line("painter: paints what it's told", "painter 1", "Good luck.") {
    apps::OptionSet paint = line.add_command("paint", "Paints a \"picture\"");
    paint.add_argument(
        "PICTURE", [](const std::string&) {}, "What to paint");
    paint.add_text(
        "--colour", "red|green|SHADE [red]", [](const std::string&) {}, "Which\n.not an order");
    paint.add_words(
        "--spare", {"door", "sill"}, [](const std::string&) {}, "What to leave");
    paint.add_number("-c,--coats", coats, 1, 5, "2", "How many");
    paint.add_flag("--wet", is_wet, "On wet ground");
    paint.set_examples("Examples:\n  dmpc paint house --wet\nPaint dries\nslowly.");
    apps::OptionSet mix = line.add_command("mix", "Mixes");
    mix.add_command("oil", "Slowly").add_flag("--wet", is_wet, "On wet ground");
    mix.add_command("water", "Quickly").add_path("-o,--output", "FILE.pot [stdout]", pot, "Where it goes");
    paint.add_text(
        "--frame", "WOOD:FILE", [](const std::string&) {}, "Which and where from");
    line.suggest("WOOD:FILE", {.words = {"oak:", "elm:"}});
    line.suggest("PICTURE", {.words = {"house", "horse"}, .files = true, .endings = {"nff", "obj"}});
    line.suggest("SHADE", {.words = {"dusk"}});
    line.suggest("FILE", {.files = true});
  }

  int coats = 2;
  bool is_wet = false;
  std::optional<std::filesystem::path> pot;
  apps::CommandLine line;
};

}  // namespace dmpc::tests
