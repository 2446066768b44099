#include "apps/checkpoints.h"

#include <ostream>
#include <system_error>
#include <utility>

#include "apps/checkpoint_file.h"
#include "apps/figures.h"
#include "core/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

std::string start_text(const fs::path& file, const core::PartialPicture& start) {
  return "going on from " + file.string() + ": " + grouped(start.done.count()) + " of " + counted(start.pixels.count(), "pixel") +
         " of pass " + std::to_string(start.passes) + " are done";
}

}  // namespace

Checkpoints::Checkpoints(const CheckpointOptions& options, PictureIdentity identity, std::ostream& messages, bool is_quiet)
    : options_(options), identity_(std::move(identity)), messages_(messages) {
  const fs::path& file = *options.file;
  if (options.resumes && fs::exists(file)) {
    start_.emplace(read_checkpoint(file, identity_));
  }
  if (options.resumes && !is_quiet) {
    messages_ << "dmpc: " << (start_ ? start_text(file, *start_) : "there is no " + file.string() + " yet: from the start")
              << '\n';
  }
}

core::Continuation Checkpoints::continuation() {
  wait_for_next();
  return {start(), [this] { return Clock::now() >= next_; },
          [this](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) { keep(film, pass, done); }};
}

void Checkpoints::wait_for_next() {
  next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.every_seconds));
}

void Checkpoints::keep(const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
  try {
    write_checkpoint(*options_.file, identity_, film, pass, done);
  } catch (const core::InputError& error) {
    messages_ << "\ndmpc: " << error.what() << "; the render goes on" << std::endl;
  }
  wait_for_next();
}

void Checkpoints::finish() const {
  if (!options_.stays) {
    std::error_code error;
    fs::remove(*options_.file, error);
    fs::remove(next_checkpoint(*options_.file), error);
  }
}

void check_checkpoint(const CheckpointOptions& options) {
  if (!options.file) {
    return;
  }
  const std::string what = "--checkpoint " + options.file->string() + ": ";
  check_output_path(*options.file, "--checkpoint");
  if (is_special(*options.file)) {
    throw core::InputError(what + "this is a pipe or device, from which nothing can be resumed");
  }
  if (fs::exists(*options.file) && !options.resumes) {
    throw core::InputError(what + "this file is there already: --resume goes on from it, or remove it to start again");
  }
}

}  // namespace dmpc::apps
