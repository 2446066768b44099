#include "apps/run/checkpoint_options.h"

#include <string>
#include <string_view>

#include "apps/frontend/line/option_values.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

using core::UsageError;

double parse_seconds(const std::string& text) {
  return parse_within(text, "--checkpoint-every", above_0, 1e6, "seconds, above 0 and at most 1000000");
}

}  // namespace

void add_options(OptionSet options, CheckpointOptions& checkpoint) {
  options.begin_group("Long renders");
  options.add_path("--checkpoint", "FILE", checkpoint.file,
                   "Save the finished part of the render in FILE from time to time, and at SIGUSR1, so that a render that was "
                   "stopped or killed can be resumed. FILE is removed when the picture is written");
  options.add_text(
      "--checkpoint-every", "SECONDS [120]",
      [&checkpoint](const std::string& text) { checkpoint.every_seconds = parse_seconds(text); },
      "Time from one checkpoint to the next");
  options.add_flag("--resume", checkpoint.resumes,
                   "Continue from --checkpoint=FILE, whatever computer and strategy wrote it, or from the start if there is no "
                   "such file yet. Of --frames, skip those whose picture exists");
  options.check_in_the_end([options, &checkpoint] {
    for (const char* option : {"--checkpoint-every", "--resume"}) {
      const bool is_of_frames = options.is_given("--frames") && std::string_view(option) == "--resume";
      if (!checkpoint.file && options.is_given(option) && !is_of_frames) {
        throw UsageError(std::string(option) + " goes with --checkpoint=FILE");
      }
    }
  });
}

}  // namespace dmpc::apps
