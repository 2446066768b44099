// The checkpoints of one render: read at its start, written on the way, removed in the end.
#pragma once

#include <chrono>
#include <iosfwd>
#include <optional>

#include "apps/checkpoint_options.h"
#include "apps/picture_identity.h"
#include "core/partial_picture.h"

namespace dmpc::apps {

/// Thread safety: made and finished by one thread; in between the host's thread alone calls what continuation() returns.
class Checkpoints {
 public:
  /// Reads the file if that is asked for, and says on `messages` what it has, unless `is_quiet`. Requires options.file. Throws
  /// core::InputError as read_checkpoint() does. `messages` outlives it.
  Checkpoints(const CheckpointOptions& options, PictureIdentity identity, std::ostream& messages, bool is_quiet);

  /// For a run, which it outlives. What cannot be written is a warning on `messages`; the last checkpoint stays.
  core::Continuation continuation();
  /// What the file had; nullptr without.
  const core::PartialPicture* start() const { return start_ ? &*start_ : nullptr; }
  /// Samples of all pixels that the file had.
  std::uint64_t samples_found_done() const { return start_ ? start_->samples_done() : 0; }
  /// The picture is written: removes the file, unless it is to stay.
  void finish() const;

 private:
  using Clock = std::chrono::steady_clock;

  void wait_for_next();
  void keep(const core::Film& film, const core::Refinement& pass, const core::PixelMask& done);

  CheckpointOptions options_;
  PictureIdentity identity_;
  std::ostream& messages_;
  std::optional<core::PartialPicture> start_;
  Clock::time_point next_;
};

/// Throws core::InputError unless the options can be followed: the file can be written, it is no pipe or device, and it is not
/// there unless it is to be resumed from.
void check_checkpoint(const CheckpointOptions& options);

}  // namespace dmpc::apps
