// The files of frames: which each has, and whose are there already.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "apps/run/render_options.h"

namespace dmpc::apps {

/// Throws core::UsageError unless each output of several frames has a place for the frame's number (apps/run/frame_name.h), but
/// for the checkpoint, of which there is one.
void check_frame_names(const RenderOptions& asked);

/// The options of one frame: with its names. Those of a frame alone may have none with a number.
RenderOptions options_of(const RenderOptions& asked, std::uint64_t frame);

/// The frames asked for whose picture is there, where names have numbers. Throws core::InputError if the folder cannot be read.
std::set<std::uint64_t> frames_there(const RenderOptions& asked);

/// A sentence if the pictures of so many frames may take more than is free where they go, however well they can be packed; empty
/// if not, or if that is not known.
std::string disk_note(const RenderOptions& asked, std::uint64_t frame_count, std::uint64_t pixel_count);

}  // namespace dmpc::apps
