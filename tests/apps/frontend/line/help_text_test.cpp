#include "apps/frontend/line/help_text.h"

#include <doctest/doctest.h>

#include <string>

namespace dmpc::tests::help_text_test {

using namespace apps;

TEST_CASE("help has usage, arguments, options by group, commands and examples, explained in one column") {
  const CommandDescription paint = {
      .name = "paint",
      .text = "Paints",
      .examples = "Examples:\n  paint house",
      .arguments = {{.value = "PICTURE", .text = "What", .is_required = true}, {.value = "MORE", .text = "", .is_list = true}},
      .options = {{.names = {"-h", "--help"}, .text = "Explain this", .group = "Options"},
                  {.names = {"--show"}, .text = "Now", .group = "Looks", .has_optional_value = true, .standard = "here"},
                  {.names = {"--a-name-that-takes-all"}, .value = "1..5 [2]", .text = "How\noften", .group = "Looks"}},
      .commands = {{.name = "oil", .text = "Slowly"}}};
  const std::string column(36, ' ');
  const auto beside = [&](std::string name, const std::string& text) {
    name.resize(column.size(), ' ');
    return name + text + "\n";
  };
  CHECK(help_text(paint, "painter paint") ==
        "Paints\nUsage: painter paint [options] PICTURE [MORE...] COMMAND\n"
        "\nArguments:\n" +
            beside("  PICTURE", "What") + beside("  MORE", "") + "\nOptions:\n" + beside("  -h,--help", "Explain this") +
            "\n\nLooks:\n" + beside("  --show{here}", "Now") + beside("  --a-name-that-takes-all 1..5 [2]", "How") + column +
            "often\n\nCommands:\n" + beside("  oil", "Slowly") + "\nExamples:\n  paint house\n");
}

TEST_CASE("what is explained stands below a name that reaches its column") {
  const std::string long_name = "--" + std::string(32, 'x');
  const CommandDescription command = {
      .name = "", .text = "", .options = {{.names = {long_name}, .text = "Why", .group = "Options"}}};
  CHECK(help_text(command, "painter") ==
        "Usage: painter [options]\n\nOptions:\n  " + long_name + "\n" + std::string(36, ' ') + "Why\n\n");
}

}  // namespace dmpc::tests::help_text_test
