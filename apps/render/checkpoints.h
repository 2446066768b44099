// The checkpoints of one render: read at its start, written on the way, removed in the end.
#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>
#include <stop_token>

#include "apps/frontend/system/file_lock.h"
#include "apps/frontend/system/files.h"
#include "apps/render/picture_identity.h"
#include "apps/run/checkpoint_options.h"
#include "core/picture/film/partial_picture.h"

namespace dmpc::apps {

/// Thread safety: made and finished by one thread; in between the host's thread alone calls what continuation() returns.
class Checkpoints {
 public:
  /// Reads the file if that is asked for, and says on `messages` what it has, unless `is_quiet`. Requires options.file. Throws
  /// core::InputError as read_checkpoint() does. `messages` and `files` outlive it. `stop` is that of the run.
  Checkpoints(const CheckpointOptions& options, PictureIdentity identity, std::ostream& messages, bool is_quiet,
              std::stop_token stop = {}, Files& files = real_files());

  /// The picture is written, and another one is next, which begins at nothing.
  void begin(PictureIdentity identity);

  /// For a run, which it outlives. What cannot be written is a warning on `messages`; the last checkpoint stays.
  core::Continuation continuation();
  /// What the file had; nullptr without.
  const core::PartialPicture* start() const { return start_ ? &*start_ : nullptr; }
  /// Samples of all pixels that the file had.
  std::uint64_t samples_found_done() const { return start_ ? start_->samples_done() : 0; }
  /// There is a checkpoint to go on from: one was read, or one has been written. Not while the run's host may be writing.
  bool has_one() const { return has_one_; }
  /// The picture is written: removes the file.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void wait_for_next();
  void keep(const core::Film& film, const core::Refinement& pass, const core::PixelMask& done);

  CheckpointOptions options_;
  std::filesystem::path file_;  ///< no symbolic link
  PictureIdentity identity_;
  std::ostream& messages_;
  std::stop_token stop_;
  Files& files_;
  std::optional<core::PartialPicture> start_;
  bool has_one_ = false;
  Clock::time_point next_;
};

/// Removes the file if it is one of this picture.
void remove_checkpoint_of(const PictureIdentity& identity, const CheckpointOptions& options, Files& files = real_files());

/// To be held as long as the file may be read, written or removed; nothing without one. Throws core::InputError unless the
/// options can be followed: the file can be written, it is no pipe or device, no other process has its checkpoint there, and it
/// is not there unless it is to be resumed from.
std::optional<FileLock> claim_checkpoint(const CheckpointOptions& options);

}  // namespace dmpc::apps
