#include "apps/run/checkpoint_options.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/usage.h"

namespace dmpc::apps::checkpoint_options_test {

using tests::typed_render;

TEST_CASE("nothing is kept unless that is asked for, and then every two minutes") {
  CHECK_FALSE(typed_render().checkpoint.file);
  const CheckpointOptions options = typed_render({"--checkpoint=a.checkpoint"}).checkpoint;
  CHECK(options.file == "a.checkpoint");
  CHECK(options.every_seconds == 120);
  CHECK_FALSE(options.resumes);
}

TEST_CASE("a checkpoint can come sooner and be resumed from") {
  const CheckpointOptions options = typed_render({"--checkpoint=a", "--checkpoint-every=0.5", "--resume"}).checkpoint;
  CHECK(options.every_seconds == 0.5);
  CHECK(options.resumes);
}

TEST_CASE("what was done before is neither on a heat map nor in virtual time") {
  CHECK(typed_render({"--checkpoint=a", "--heatmap=rays:b.png"}).checkpoint.file == "a");
}

}  // namespace dmpc::apps::checkpoint_options_test
