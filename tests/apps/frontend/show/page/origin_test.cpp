#include "apps/frontend/show/page/origin.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/render/picture_identity.h"
#include "apps/scene/load_scene.h"
#include "tests/support/text.h"

namespace dmpc::apps::origin_test {

TEST_CASE("a command is as a shell takes it, without the program's folder") {
  CHECK(command_text(std::vector<std::string>{"/usr/bin/dmpc", "render", "my scene.nff", "--nodes=8", "it's", "", "$(x)"}) ==
        "dmpc render 'my scene.nff' --nodes=8 'it'\\''s' '' '$(x)'");
  CHECK(command_text({}).empty());
  CHECK(command_text(std::vector<std::string>{"dmpc", "a\nb\t'\\\x1b"}) == "dmpc $'a\\012b\\011\\'\\\\\\033'");
}

TEST_CASE("a word that a shell takes as one, and as it stands, is told from what it would take apart or run") {
  for (const std::string word : {"render", "--nodes=8", "'my scene.nff'", "'it'\\''s'", "''", "'$(x)'", "'`x`'", "'\\'",
                                 "$'a\\012b\\011\\033[0m'", "$'it\\'s \\\\\\001'"}) {
    CHECK_MESSAGE(is_shell_word(word), word);
  }
  for (const std::string word :
       {"",        "my scene", "$(x)",      "`x`",        "a;b",        "a&",     "'",       "'a'b'", "a'b'",
        "'a' 'b'", "'a\n'",    "'\x1b[0m'", "'render'",   "#",          "~",      "*",       "$'",    "$''",
        "$'a'",    "$'\\000'", "$'a\n'",    "$'\\012' b", "$'\\012'b'", "$'\\n'", "$'\\777'"}) {
    CHECK_FALSE_MESSAGE(is_shell_word(word), word);
  }
}

TEST_CASE("a page's date is that of SOURCE_DATE_EPOCH, or now where this is no number") {
  CHECK(date_text("0", 86'400) == "1970-01-01 00:00 UTC");
  CHECK(date_text("1795384800", 0) == "2026-11-22 22:00 UTC");
  for (const char* const epoch : {static_cast<const char*>(nullptr), "", "soon", "12x", "-1", "999999999999999999"}) {
    CHECK(date_text(epoch, 86'400) == "1970-01-02 00:00 UTC");
  }
}

TEST_CASE("a process knows its command, its version and its computer") {
  const Origin origin = this_origin(7);
  CHECK_FALSE(origin.command.empty());
  CHECK(origin.command.substr(0, origin.command.find(' ')).find('/') == std::string::npos);
  CHECK(tests::contains(origin.program, "dmpc 0."));
  CHECK(tests::contains(origin.program, " build, "));
  CHECK(tests::contains(origin.computer, "processor"));
  CHECK(origin.scene_digest == 7);
}

TEST_CASE("scenes that differ in one number have digests that differ") {
  PictureOptions options;
  options.scene = "balls-1";
  const core::Scene scene = load_scene(options);
  core::Scene moved = scene, seen = scene;
  moved.spheres.front().radius *= 1.0000001;
  seen.view.from.x += 1e-9;
  CHECK(scene_digest(scene) == scene_digest(load_scene(options)));
  CHECK(scene_digest(moved) != scene_digest(scene));
  CHECK(scene_digest(seen) != scene_digest(scene));
}

}  // namespace dmpc::apps::origin_test
