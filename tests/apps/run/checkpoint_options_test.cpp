#include "apps/run/checkpoint_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/main/commands.h"
#include "apps/run/render_options.h"
#include "core/base/expect.h"
#include "tests/support/text.h"
#include "tests/support/usage.h"

namespace dmpc::apps::checkpoint_options_test {

using tests::contains;
using tests::render_usage_complaint;

namespace {

CheckpointOptions parse(std::vector<std::string> more) {
  more.insert(more.begin(), {"render", "teapot-12", "-o", "a.png"});
  return parse_command_line(more).options<RenderOptions>().checkpoint;
}

}  // namespace

TEST_CASE("nothing is kept unless that is asked for, and then every two minutes") {
  CHECK_FALSE(parse({}).file);
  const CheckpointOptions options = parse({"--checkpoint=a.checkpoint"});
  CHECK(options.file == "a.checkpoint");
  CHECK(options.every_seconds == 120);
  CHECK_FALSE(options.resumes);
}

TEST_CASE("a checkpoint can come sooner and be resumed from") {
  const CheckpointOptions options = parse({"--checkpoint=a", "--checkpoint-every=0.5", "--resume"});
  CHECK(options.every_seconds == 0.5);
  CHECK(options.resumes);
}

TEST_CASE("the options of checkpoints need a file") {
  for (const std::string option : {"--resume", "--checkpoint-every=3"}) {
    CHECK(contains(render_usage_complaint({option}), "goes with --checkpoint=FILE"));
  }
}

TEST_CASE("what was done before is neither on a heat map nor in virtual time") {
  CHECK(parse({"--checkpoint=a", "--heatmap=rays:b.png"}).file == "a");
}

}  // namespace dmpc::apps::checkpoint_options_test
