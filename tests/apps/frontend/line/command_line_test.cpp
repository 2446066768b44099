#include "apps/frontend/line/command_line.h"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "core/base/expect.h"
#include "tests/support/complaint.h"

namespace dmpc::apps::command_line_test {

namespace {

enum class Colour { red, green };

/// What a line of the command `paint` or `wash` set.
struct Said {
  Colour colour = Colour::green;
  std::optional<Colour> frame;
  Colour varnish = Colour::red;
  std::string tin;
  int coats = 2;
  std::optional<std::uint32_t> layers;
  std::vector<std::string> spared;
  bool is_wet = false, colour_given = false;
};

struct Line {
  Line() : line("a painter", "painter 1", "good luck") {
    OptionSet paint = line.add_command("paint", "Paints");
    paint.add_choice<Colour>("--colour", said.colour, {{"red", Colour::red}, {"green", Colour::green}}, "Which");
    paint.add_choice<Colour>("--frame", said.frame, {{"red", Colour::red}, {"green", Colour::green}}, "none", "Which");
    paint.add_number("--coats", said.coats, -1, 5, "2", "How many");
    paint.add_number("--layers", said.layers, 0, 0xffffffff, "few", "How many");
    paint.add_words(
        "--spare", {"door", "sill"}, [this](const std::string& word) { said.spared.push_back(word); }, "What to leave");
    paint.add_choice<Colour>("--varnish", said.varnish, {{"red", Colour::red}, {"green", Colour::green}},
                             {.shown = "TIN",
                              .take =
                                  [this](const std::string& text) {
                                    said.tin = text.starts_with("/") ? text : "";
                                    return !said.tin.empty();
                                  }},
                             "Which");
    paint.add_choice<Colour>("--quality", said.colour, {{"good", Colour::red}}, "red", "How");
    paint.add_flag("--wet", said.is_wet, "On wet ground");
    paint.check_in_the_end([this, paint] { said.colour_given = paint.is_given("--colour"); });
    line.add_command("wash", "Washes");
    line.add_command("dry", "Dries");
    OptionSet mix = line.add_command("mix", "Mixes");
    mix.add_command("oil", "Slowly");
    mix.add_command("water", "Quickly").add_flag("--wetter", said.is_wet, "With more water");
  }
  std::variant<HelpText, std::string> parse(std::initializer_list<std::string> words) {
    return line.parse(std::vector<std::string>(words));
  }
  std::string complaint(std::initializer_list<std::string> words) {
    return tests::complaint_of<core::UsageError>([&] { parse(words); });
  }

  Said said;
  CommandLine line;
};

}  // namespace

TEST_CASE("what is not given keeps its default") {
  Line line;
  CHECK(std::get<std::string>(line.parse({"paint"})) == "paint");
  CHECK(line.said.colour == Colour::green);
  CHECK_FALSE(line.said.frame);
  CHECK(line.said.coats == 2);
  CHECK_FALSE(line.said.layers);
  CHECK_FALSE(line.said.colour_given);
}

TEST_CASE("what is given is taken, and known to be given even where it is the default") {
  Line line;
  line.parse({"paint", "--colour=green", "--frame=red", "--coats=-1", "--layers=4294967295", "--wet"});
  CHECK(line.said.colour == Colour::green);
  CHECK(line.said.frame == Colour::red);
  CHECK(line.said.coats == -1);
  CHECK(line.said.layers == 4294967295U);
  CHECK(line.said.is_wet);
  CHECK(line.said.colour_given);
}

TEST_CASE("a list of words may be given piece by piece") {
  Line line;
  line.parse({"paint", "--spare", "sill", "--spare=door"});
  CHECK(line.said.spared == std::vector<std::string>{"sill", "door"});
}

TEST_CASE("a choice may have other values than its words, which then are not refused") {
  Line line;
  line.parse({"paint", "--varnish=/a/tin"});
  CHECK(line.said.tin == "/a/tin");
  CHECK(line.said.varnish == Colour::red);
  Line word;
  word.parse({"paint", "--varnish=green"});
  CHECK(word.said.tin.empty());
  CHECK(word.said.varnish == Colour::green);
  CHECK(Line().complaint({"paint", "--varnish=grean"}) ==
        "--varnish=grean: expected red or green or TIN. Did you mean green?\nTry: dmpc paint --help");
  CHECK(std::get<HelpText>(Line().parse({"paint", "--help"})).text.find("red|green|TIN [red]") != std::string::npos);
}

TEST_CASE("a value that is called otherwise now is taken, and each line that has it says so") {
  for (int again = 0; again < 2; ++again) {
    Line line;
    line.parse({"paint", "--quality=default"});
    CHECK(line.said.colour == Colour::red);
    CHECK(line.line.notes() == std::vector<std::string>{"--quality=default is called good now"});
  }
  Line line;
  line.parse({"paint", "--quality=good"});
  CHECK(line.line.notes().empty());
}

TEST_CASE("of an option that nobody has typed it is said what stands for it") {
  const auto complaint = [](std::initializer_list<std::string> words) {
    CommandLine line("a painter", "painter 1", "good luck");
    OptionSet paint = line.add_command("paint", "Paints");
    bool is_wet = false;
    std::string colour;
    paint.add_argument(
        "WALL", [](const std::string&) {}, "What");
    paint.add_text(
        "--colour", "COLOUR", [&](const std::string& text) { colour = text; }, "Which");
    paint.add_flag("--wet", is_wet, "On wet ground");
    paint.check_in_the_end([&] {
      if (is_wet && !colour.empty()) {
        throw core::UsageError("--colour=" + colour + " does not go with --wet");
      }
    });
    line.stand_for_options({"WALL", [](const std::string&, const CommandLine::Standing::Given&) {
                              return std::vector<std::string>{"--colour=red"};
                            }});
    return tests::complaint_of<core::UsageError>([&] { line.parse(std::vector<std::string>(words)); });
  };
  CHECK(complaint({"paint", "north", "--wet"}) ==
        "--colour=red does not go with --wet; nobody typed --colour=red, but north was built with it\nTry: dmpc paint --help");
  CHECK(complaint({"paint", "north", "--wet", "--colour=red"}) == "--colour=red does not go with --wet\nTry: dmpc paint --help");
}

TEST_CASE("the command given is named, and a wrong one answered with all there are") {
  CHECK(std::get<std::string>(Line().parse({"wash"})) == "wash");
  CHECK(Line().complaint({"scrub"}) == "scrub is no command: expected paint, wash, dry or mix\nTry: dmpc --help");
  CHECK(Line().complaint({}).find("Try: dmpc --help") != std::string::npos);
}

TEST_CASE("a command of a command is named by both, and its options are its own") {
  Line line;
  CHECK(std::get<std::string>(line.parse({"mix", "water", "--wetter"})) == "mix water");
  CHECK(line.said.is_wet);
  CHECK(Line().complaint({"mix", "sand"}) == "sand is no command: expected oil or water\nTry: dmpc mix --help");
  CHECK(Line().complaint({"mix", "oil", "--wetter"}).find("Try: dmpc mix oil --help") != std::string::npos);
  CHECK(Line().complaint({"mix"}).find("Try: dmpc mix --help") != std::string::npos);
  CHECK(std::get<HelpText>(Line().parse({"mix", "--help"})).text.find("Quickly") != std::string::npos);
}

TEST_CASE("a wrong value names its option and where help is") {
  for (const std::string word : {"--colour=blue", "--frame=", "--coats=6", "--coats=-2", "--coats=1.5", "--coats=two",
                                 "--layers=4294967296", "--spare=wall", "--hue=1"}) {
    CAPTURE(word);
    CHECK(Line().complaint({"paint", word}).find(word.substr(0, word.find('='))) != std::string::npos);
    CHECK(Line().complaint({"paint", word}).find("Try: dmpc paint --help") != std::string::npos);
  }
}

TEST_CASE("help shows values, ranges and defaults") {
  Line line;
  const std::string text = std::get<HelpText>(line.parse({"paint", "--help"})).text;
  for (const std::string part :
       {"red|green [green]", "red|green [none]", "-1..5 [2]", "0..4294967295 [few]", "door|sill", "On wet ground"}) {
    CHECK_MESSAGE(text.find(part) != std::string::npos, part);
  }
  CHECK(std::get<HelpText>(Line().parse({"--version"})).text == "painter 1\n");
}

}  // namespace dmpc::apps::command_line_test
