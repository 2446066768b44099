// The files of frames: which each has, and whose are there already.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "apps/frontend/system/output_set.h"
#include "apps/run/render_options.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {

/// A picture that is to be made: one of several, or the only one.
struct DueFrame {
  std::optional<std::uint64_t> number;  ///< nothing without --frames
  RenderOptions options;                ///< with its names
  OutputSet<RenderRecord> outputs;
};

/// The frames of a call whose pictures are not there. Thread safety: none.
class DueFrames {
 public:
  /// `asked`, with names for all frames, outlives it. Throws core::UsageError unless each output of several frames has a field
  /// for the frame's number (apps/run/frame_name.h), except the checkpoint, of which there is one; core::InputError if the folder
  /// cannot be read, or if a picture exists already that is not to be skipped.
  explicit DueFrames(const RenderOptions& asked);

  /// How many are there, in a sentence; empty if there is none.
  std::string note() const;
  bool was_there(std::uint64_t frame) const { return there_.contains(frame); }

  /// The first; nothing if all are there.
  std::optional<DueFrame> first() const;
  /// The next of those that are not there by now: another process may have made them. Throws core::InputError if one has come
  /// there that nobody wants to leave out.
  std::optional<DueFrame> after(const DueFrame& last) const;

  /// A warning if the pictures of `pixel_count` pixels may need more disk space than is free, even if they are compressed well;
  /// empty if not, or if that is unknown.
  std::string disk_note(std::uint64_t pixel_count) const;

 private:
  std::optional<DueFrame> missing_from(std::uint64_t number) const;
  bool is_there_by_now(std::uint64_t number) const;

  const RenderOptions& asked_;
  std::set<std::uint64_t> there_;  ///< from the beginning
};

}  // namespace dmpc::apps
