// The checkpoints of one render: read at its start, written during it, removed at its end.
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

/// Thread safety: made and finished by one thread; in between only the host's thread calls what continuation() returns.
class Checkpoints {
 public:
  /// Reads the file if that is asked for, and reports its state on `messages`, unless `is_quiet`. Requires options.file. Throws
  /// core::InputError as read_checkpoint() does. `messages` and `files` outlive it. `stop` is the run's.
  Checkpoints(const CheckpointOptions& options, PictureIdentity identity, std::ostream& messages, bool is_quiet,
              std::stop_token stop = {}, Files& files = real_files());

  /// Begins the next picture, from nothing; the last one has been written.
  void begin(PictureIdentity identity);

  /// For a run, which it outlives. A checkpoint that cannot be written is a warning on `messages`; the last one stays.
  core::Continuation continuation();
  /// The file's contents; nullptr without.
  const core::PartialPicture* start() const { return start_ ? &*start_ : nullptr; }
  /// Sum of the samples in the file over all pixels.
  std::uint64_t samples_found_done() const { return start_ ? start_->samples_done() : 0; }
  /// Whether there is a checkpoint to resume from: one was read, or one has been written. Not while the run's host may be
  /// writing.
  bool has_one() const { return has_one_; }
  /// Removes the file; the picture has been written.
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

/// Held while the file may be read, written or removed; nothing without a checkpoint. Throws core::InputError unless the file can
/// be written, is no pipe or device, is not locked by another process, and does not exist unless it is to be resumed from.
std::optional<FileLock> claim_checkpoint(const CheckpointOptions& options);

}  // namespace dmpc::apps
