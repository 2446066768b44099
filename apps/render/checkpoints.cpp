#include "apps/render/checkpoints.h"

#include <ostream>
#include <system_error>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/render/checkpoint_file.h"
#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

namespace fs = std::filesystem;

std::string start_text(const fs::path& file, const core::PartialPicture& start) {
  return "continuing from " + file.string() + ": " + grouped(start.done.count()) + " of " +
         counted(start.pass.pixel_count(), "pixel") + " of pass " + std::to_string(start.passes) + " are done";
}

bool is_there(const fs::path& file) {
  std::error_code error;
  const bool is_found = fs::exists(file, error);
  if (error) {
    throw core::InputError("--checkpoint " + file.string() + ": cannot be examined: " + error.message());
  }
  return is_found;
}

}  // namespace

Checkpoints::Checkpoints(const CheckpointOptions& options, PictureIdentity identity, std::ostream& messages, bool is_quiet,
                         std::stop_token stop, Files& files)
    : options_(options),
      file_(file_behind(*options.file)),
      identity_(std::move(identity)),
      messages_(messages),
      stop_(std::move(stop)),
      files_(files) {
  const fs::path& file = *options.file;
  if (options.resumes && is_there(file_)) {
    start_.emplace(read_checkpoint(file_, identity_, files_));
    has_one_ = true;
  }
  if (options.resumes && !is_quiet) {
    messages_ << "dmpc: "
              << (start_ ? start_text(file, *start_) : "there is no " + file.string() + " yet: starting from the beginning")
              << '\n';
  }
}

void Checkpoints::begin(PictureIdentity identity) {
  identity_ = std::move(identity);
  start_.reset();
  has_one_ = false;
  wait_for_next();
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
    write_checkpoint(file_, identity_, film, pass, done, files_);
    has_one_ = true;
  } catch (const core::InputError& error) {
    messages_ << "\ndmpc: " << error.what() << (stop_.stop_requested() ? "" : "; the render goes on") << std::endl;
  }
  wait_for_next();
}

void Checkpoints::finish() {
  has_one_ = false;
  files_.remove(file_);
  files_.remove(next_name(file_));  // left by a process that was killed
}

void remove_checkpoint_of(const PictureIdentity& identity, const CheckpointOptions& options, Files& files) {
  const fs::path file = file_behind(*options.file);
  try {
    if (!options.resumes || !is_there(file)) {
      return;
    }
    read_checkpoint(file, identity, files);
  } catch (const core::InputError&) {
    return;  // whoever goes on from it says what is wrong
  }
  files.remove(file);
}

std::optional<FileLock> claim_checkpoint(const CheckpointOptions& options) {
  if (!options.file) {
    return std::nullopt;
  }
  const std::string what = "--checkpoint " + options.file->string() + ": ";
  if (is_special(*options.file) && !fs::is_directory(*options.file)) {
    throw core::InputError(what + "this is a pipe or device, from which no render can be resumed");
  }
  check_output_path(*options.file, "--checkpoint");
  std::optional<FileLock> lock = FileLock::try_lock(hidden_name(file_behind(*options.file), "lock"));
  if (!lock) {
    throw core::InputError(what + "another dmpc writes its checkpoint there");
  }
  if (is_there(*options.file) && !options.resumes) {
    throw core::InputError(what + "this file exists already: continue from it with --resume, or remove it to start again");
  }
  return lock;
}

}  // namespace dmpc::apps
