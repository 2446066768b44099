// The output files of frames, and the frames that exist already.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "apps/frontend/system/output_set.h"
#include "apps/run/render_options.h"
#include "apps/run/render_record.h"

namespace dmpc::apps {

/// A picture to be rendered: one of several, or the only one.
struct DueFrame {
  std::optional<std::uint64_t> number;  ///< nothing without --frames
  RenderOptions options;                ///< with its file names
  OutputSet<RenderRecord> outputs;
};

/// The frames whose pictures do not exist yet. Thread safety: none.
class DueFrames {
 public:
  /// `asked`, with names for all frames, outlives it. Throws core::UsageError unless each output of several frames has a field
  /// for the frame's number (apps/run/frame_name.h), except the checkpoint, of which there is one; core::InputError if the folder
  /// cannot be read, or if a picture exists already that is not to be skipped.
  explicit DueFrames(const RenderOptions& asked);

  /// The number of existing frames, in a sentence; empty if there is none.
  std::string note() const;
  bool was_there(std::uint64_t frame) const { return there_.contains(frame); }

  /// The first frame to render; nothing if all exist.
  std::optional<DueFrame> first() const;
  /// The next frame that does not exist by now: another process may have made some. Throws core::InputError if one has appeared
  /// that is not to be skipped.
  std::optional<DueFrame> after(const DueFrame& last) const;

  /// A warning if the pictures of `pixel_count` pixels may need more disk space than is free, even if they are compressed well;
  /// empty if not, or if that is unknown.
  std::string disk_note(std::uint64_t pixel_count) const;

 private:
  std::optional<DueFrame> missing_from(std::uint64_t number) const;
  bool is_there_by_now(std::uint64_t number) const;

  const RenderOptions& asked_;
  std::set<std::uint64_t> there_;  ///< frames that existed at the beginning
};

}  // namespace dmpc::apps
