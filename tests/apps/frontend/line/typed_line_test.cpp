// What newcomers type wrong, and what they read then.

#include "apps/frontend/line/typed_line.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/frontend/line/command_line.h"
#include "apps/frontend/line/words.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::typed_line_test {

namespace {

using Words = std::vector<std::string>;

/// The words of a line; '' is an empty one.
Words typed(const std::string& line) {
  Words words = words_between(line, ' ');
  for (std::string& word : words) {
    word = word == "''" ? "" : word;
  }
  return words;
}

std::string answer_to(const std::string& line) {
  const std::string complaint = tests::usage_complaint(typed(line));
  return complaint.empty() ? "nothing" : complaint;
}

/// What is typed behind dmpc, and a part of the answer.
struct Slip {
  const char* line;
  const char* answer;
};

constexpr Slip slips[] = {
    // commands
    {"rendr teapot-12 -o a.png", "rendr is no command: expected render, view, info"},
    {"rendr teapot-12 -o a.png", "Did you mean render?"},
    {"Render teapot-12 -o a.png", "Did you mean render?"},
    {"speedup rings-3", "Did you mean study speedup?"},
    {"stability", "Did you mean bench stability?"},
    {"study", "a command is missing: expected dmpc study balance, traffic, cache"},
    {"study balanse rings-3", "Did you mean balance?\nTry: dmpc study --help"},
    {"study rings-3", "rings-3 is no command: expected balance"},
    {"bench", "a command is missing: expected dmpc bench stability"},
    {"--nodes=4 render teapot-12", "options follow their command, as in dmpc render --nodes\nTry: dmpc --help"},
    {"study --format=csv balance rings-3", "--format is no option of dmpc study: options follow their command"},
    {"teapot-12", "teapot-12 is no command"},
    {"''", "an empty word is no command"},
    // options
    {"render teapot-12 --nods=4 -o a.png", "--nods is no option of dmpc render. Did you mean --nodes?"},
    {"render teapot-12 --node=4 -o a.png", "Did you mean --nodes?"},
    {"render teapot-12 --ouput=a.png", "Did you mean --output?"},
    {"render teapot-12 --resol=8x8 -o a.png", "Did you mean --resolution?"},
    {"render teapot-12 --NODES=4 -o a.png", "Did you mean --nodes?"},
    {"render teapot-12 -nodes=4 -o a.png", "-nodes is no option of dmpc render. Did you mean --nodes?"},
    {"render teapot-12 -nodes 4 -o a.png", "Did you mean --nodes?"},
    {"render teapot-12 -x -o a.png", "-x is no option of dmpc render.\n"},
    {"render teapot-12 -q -o a.png", "-q is no option of dmpc render.\n"},
    {"render teapot-12 --verbose -o a.png", "--verbose is no option of dmpc render.\n"},
    {"info teapot-12 --stats=a.json", "--stats is no option of dmpc info, but of dmpc render\nTry: dmpc info --help"},
    {"check teapot-12 -o a.png", "-o is no option of dmpc check"},
    {"study balance rings-3 --per-nodes", "Did you mean --per-node?"},
    // values
    {"render teapot-12 --nodes= -o a.png", "--nodes=: a value is missing; expected --nodes=1.."},
    {"render teapot-12 --nodes -o a.png", "--nodes: a value is missing, and -o is an option; expected --nodes=1.."},
    {"render teapot-12 -o a.png --nodes", "--nodes: a value is missing; expected --nodes=1.."},
    {"render teapot-12 -o", "-o: a value is missing; expected -o IMAGE or --output=IMAGE"},
    {"render teapot-12 -o --nodes=4", "-o: a value is missing, and --nodes=4 is an option"},
    {"render teapot-12 -o ''", "-o: a value is missing"},
    {"render teapot-12 --output= --nodes=4", "--output=: a value is missing; expected -o IMAGE"},
    {"render teapot-12 -o=a.png", "-o=a.png: expected -o IMAGE or --output=IMAGE"},
    {"render teapot-12 -output a.png", "-output: expected -o IMAGE or --output=IMAGE"},
    {"render teapot-12 -o a.png --quiet=5", "--quiet=5: --quiet takes no value; give --quiet alone"},
    {"render teapot-12 -o a.png --quiet=", "--quiet takes no value"},
    {"render teapot-12 -o a.png --quiet=false", "or leave it out"},
    {"render teapot-12 -o a.png --resume=c.ck", "--resume takes no value"},
    {"render teapot-12 -o a.png --serve=", "--serve=: a value is missing"},
    {"bench stability --quick=yes", "--quick takes no value"},
    {"render teapot-12 -o a.png --nodes=4 --nodes=8", "--nodes is given twice, as 4 and as 8: give it once"},
    {"render teapot-12 -o a.png -o b.png", "-o is given twice, as a.png and as b.png"},
    {"render teapot-12 --output=a.png -o b.png", "is given twice"},
    // numbers and words
    {"render teapot-12 -o a.png --nodes=four", "--nodes=four: expected a whole number from 1 to "},
    {"render teapot-12 -o a.png --nodes=0", "--nodes=0: expected a whole number from 1 to "},
    {"render teapot-12 -o a.png --nodes=-3", "--nodes=-3: expected a whole number"},
    {"render teapot-12 -o a.png --nodes=1e3", "--nodes=1e3: expected a whole number"},
    {"render teapot-12 -o a.png --nodes=2.5", "--nodes=2.5: expected a whole number"},
    {"render teapot-12 -o a.png --nodes=4,8", "--nodes=4,8: expected a whole number"},
    {"render teapot-12 -o a.png --nodes=99999999999999999999", "expected a whole number from 1 to "},
    {"render teapot-12 -o a.png --depth=256", "--depth=256: expected a whole number from 1 to 255"},
    {"render teapot-12 -o a.png --strategy=svn",
     "--strategy=svn: expected svm, replicated, dataflow or forest. Did you mean svm?"},
    {"render teapot-12 -o a.png --strategy=SVM", "Did you mean svm?"},
    {"render teapot-12 -o a.png --strategy=rays", "--strategy=rays: expected svm, replicated, dataflow or forest\n"},
    {"render teapot-12 -o a.png --replacement=LRU", "Did you mean lru?"},
    {"render teapot-12 -o a.png --runner=virtal", "Did you mean virtual?"},
    {"render teapot-12 -o a.png --tracer=embre", "Did you mean embree?"},
    {"render teapot-12 -o a.png --quality=high", "--quality=high: expected draft or good"},
    {"render teapot-12 -o a.png --convention=hanes", "Did you mean haines?"},
    {"render teapot-12 -o a.png --no-skip=anyhit", "Did you mean any-hit?"},
    {"render teapot-12 -o a.png --heatmap=fault:f.png", "Did you mean faults?"},
    {"render teapot-12 -o a.png --heatmap=faults", "a colon and a file, such as rays:rays.png"},
    {"render teapot-12 -o a.png --heatmap=faults:f.gif", "a file with the ending .exr"},
    {"render teapot-12 -o a.png --resolution=640", "expected WIDTHxHEIGHT such as 512x384"},
    {"render teapot-12 -o a.png --resolution=640X480", "expected WIDTHxHEIGHT"},
    {"render teapot-12 -o a.png --node-memory=4MB", "expected a size such as 4096B, 300KiB, 4MiB"},
    {"render teapot-12 -o a.png --samples=0", "expected a whole number from 1 to 32768, or auto"},
    {"render teapot-12 -o a.png --report=r.htm", "expected a file with the ending .html"},
    {"render teapot-12 -o a.png --machine=ipsc2", "--machine does not go with --runner=threads"},
    {"study balance rings-3 --nodes=4,,8", "a word is missing"},
    {"study balance rings-3 --format=xml", "--format=xml: expected markdown, csv, json or jsonl"},
    {"bench speed --parts=kernels", "Did you mean kernel?"},
    {"list machine", "Did you mean machines?"},
    {"help rendr", "Did you mean render?"},
    {"help study balence", "Did you mean balance?"},
    {"help glosary", "Did you mean glossary?"},
    // as other renderers have it
    {"render a.obj -o a.png --width=640",
     "--width is no option of dmpc render: expected --resolution=WxH, the pixels of both sides"},
    {"render a.obj -o a.png --height 480", "expected --resolution=WxH"},
    {"render a.obj -o a.png +W640 +H480", "+W640 is no option: expected --resolution=WxH"},
    {"render a.obj -o a.png --fov=60", "expected --camera=FROM/AT[/UP[/DEGREES]], which ends with the angle"},
    {"render a.obj -o a.png -fov 60", "-fov is no option of dmpc render: expected --camera="},
    {"render a.obj -o a.png --spp=16", "expected --samples=1..32768|auto, the samples per pixel"},
    {"render a.obj -o a.png -j8", "-j8 is no option of dmpc render: expected --nodes="},
    {"render a.obj -o a.png -n 4", "-n is no option of dmpc render: expected --nodes="},
    {"render a.obj -o a.png --threads=4", "each of which is a thread"},
    {"render a.obj --outfile a.png", "expected -o IMAGE or --output=IMAGE, the picture"},
    {"list machines --width=640", "--width is no option of dmpc list"},
    // as dmpc had it
    {"render a.obj --preview -o a.png", "--preview is no option of dmpc render any more: --serve shows the picture"},
    {"render a.obj -preview -o a.png", "-preview is no option of dmpc render any more: --serve shows the picture"},
    {"info a.obj --preview", "--preview is no option of dmpc info any more: --serve shows the picture"},
    {"study sweep rings-3 --vary=preview:on,off", "--vary=preview:on,off: preview is no option of dmpc render any more: --serve"},
    {"render a.obj --no-skip=any-hit,empty-space -o a.png",
     "--no-skip=empty-space no longer exists: empty voxels are passed over"},
    {"render a.obj --strip=a.png -o a.png", "any more: --heatmap=done:FILE.png shows when each pixel was done"},
    {"render a.obj --trace-every=4 -o a.png", "any more: --trace-window=FROM,TO records all pixels"},
    {"render a.obj --trace-events=9 -o a.png", "any more: a million events are kept, spread over the run"},
    {"render a.obj --trace-keep=last -o a.png", "any more: a trace too long is kept in parts from all times"},
    {"render a.obj --trace-nodes=host -o a.png", "any more: --trace records all nodes"},
    {"bench stability --resume=a", "--resume is no option of dmpc bench stability any more: a long run may be made of several"},
    {"render a.obj --tree-arity=4 -o a.png", "--tree-arity is no option of dmpc render any more: --homes=tree has three"},
    {"render a.obj --topology=mesh -o a.png", "dmpc study balance --topology=KIND compares"},
    {"render a.obj --occlusion=2 -o a.png", "--occlusion is no option of dmpc render any more: --sky=1 --bounces=0 lights"},
    {"study speedup rings-3 --memory-port", "--machine=FILE.json names a machine whose has_memory_port is true"},
    {"study balance rings-3 --balance-grid=8", "loads are counted in 256x256 columns"},
    // arguments
    {"render", "SCENE is missing: expected dmpc render SCENE -o IMAGE\nTry: dmpc render --help"},
    {"render -o a.png", "SCENE is missing: expected dmpc render SCENE -o IMAGE"},
    {"render teapot-12", "-o is missing: expected dmpc render SCENE -o IMAGE"},
    {"render '' -o a.png", "SCENE is empty"},
    {"render my teapot.obj -o a.png", "'teapot.obj' is an argument too many: expected dmpc render SCENE -o IMAGE"},
    {"render teapot-12 nodes=8 -o a.png", "Did you mean --nodes=8?"},
    {"render teapot-12 a.png", "'a.png' is an argument too many"},
    {"compare a.exr", "B is missing: expected dmpc compare A B"},
    {"compare a.exr b.exr c.exr", "'c.exr' is an argument too many"},
    {"machine", "MACHINE is missing: expected dmpc machine MACHINE"},
};

}  // namespace

TEST_CASE("what is typed wrong is answered by what is wrong, what was expected, and where help is") {
  for (const Slip& slip : slips) {
    const std::string answer = answer_to(slip.line);
    CHECK_MESSAGE(tests::contains(answer, slip.answer), "dmpc " << slip.line << "\n  says: " << answer);
    CHECK_MESSAGE(tests::contains(answer, "\nTry: dmpc "), answer);
    CHECK_MESSAGE(tests::contains(answer, " --help"), answer);
  }
}

TEST_CASE("what is typed in other ways is taken as the same") {
  const auto words_of = [](const std::string& line) { return read_line(describe_command_line(), typed(line)).words; };
  const Words words = words_of("render teapot-12 --output=a.png --nodes=4 --quiet");
  CHECK(words == Words{"render", "--output=a.png", "--nodes=4", "--quiet", "--", "teapot-12"});
  CHECK(words_of("render -o a.png --nodes 4 --quiet teapot-12") == words);
  CHECK(words_of("render -oa.png --nodes=4 --quiet -- teapot-12") == words);
  CHECK(words_of("compare -- -a.exr --b.exr") == Words{"compare", "--", "-a.exr", "--b.exr"});
}

TEST_CASE("what begins like a short option is a value, where it is no option") {
  const TypedLine line = read_line(describe_command_line(), typed("render a --camera -1,2,3/0,0,0 -o -"));
  CHECK(line.words == Words{"render", "--camera=-1,2,3/0,0,0", "--output=-", "--", "a"});
}

TEST_CASE("an option that may be given several times and a flag may") {
  CHECK(answer_to("render teapot-12 -o a.png --light=1,2,3 --light=4,5,6 --quiet --quiet") == "nothing");
}

TEST_CASE("help is given whatever else is wrong, but not about a command that there is none") {
  for (const char* const line : {"render --help", "render --nods=4 --help", "render -o -h", "render a b c --nodes= --help"}) {
    const TypedLine read = read_line(describe_command_line(), typed(line));
    CHECK_MESSAGE(read.asks_for_help, line);
    CHECK(read.command == "render");
  }
  CHECK(read_line(describe_command_line(), typed("study cache -h")).command == "study cache");
  CHECK(read_line(describe_command_line(), typed("--help")).command.empty());
  CHECK(tests::contains(answer_to("rendr --help"), "Did you mean render?"));
  CHECK(tests::contains(answer_to("study balanse --help"), "Did you mean balance?"));
}

TEST_CASE("the version is told whatever follows") {
  CHECK(parse_command_line(typed("--version")).options<HelpText>().text.starts_with("dmpc "));
  CHECK(tests::contains(answer_to("--verison"), "Did you mean --version?"));
}

TEST_CASE("help about a command is what the command says of itself, and about words the glossary") {
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  CHECK(text("help render") == text("render --help"));
  CHECK(text("help study cache") == text("study cache --help"));
  CHECK(text("help") == text("--help"));
  CHECK(tests::contains(text("help glossary"), "work item"));
}

TEST_CASE("a word that tables show or an option takes is explained, in each of its meanings") {
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  CHECK(text("help page").starts_with("page: "));
  CHECK(text("help Pages").starts_with("page: "));
  CHECK(text("help page wait").starts_with("wait: "));
  CHECK(text("help hdr").starts_with("hdr (--machine=hdr): "));
  CHECK(text("help cache-pages").starts_with("dmpc render --cache-pages="));
  CHECK(tests::contains(text("help svm"), "\nsvm (--strategy=svm): "));
  CHECK(tests::contains(text("help svm"), "\nsvm (--system=svm): "));
  CHECK(tests::contains(answer_to("help submop"), "there is no help about 'submop'"));
  CHECK(tests::contains(answer_to("help submop"), "Did you mean submap?"));
}

TEST_CASE("help is in two sizes where a command says which options matter first, and what it names there is one") {
  const CommandDescription program = describe_command_line();
  const auto text = [](const std::string& line) { return parse_command_line(typed(line)).options<HelpText>().text; };
  const std::string brief = text("render --help");
  CHECK(std::count(brief.begin(), brief.end(), '\n') < 40);
  CHECK(text("render --help=all").size() > 4 * brief.size());
  CHECK(text("list --help") == text("list --help=all"));
  for (const CommandDescription& command : program.commands) {
    for (const BriefGroup& group : command.brief) {
      for (const auto& [name, meaning] : group.rows) {
        const std::string word = name.substr(0, name.find_first_of(", "));
        CHECK_MESSAGE(
            std::ranges::any_of(command.options,
                                [&](const OptionDescription& option) { return std::ranges::count(option.names, word) == 1; }),
            name);
        CHECK_FALSE(meaning.empty());
      }
    }
  }
}

}  // namespace dmpc::apps::typed_line_test
