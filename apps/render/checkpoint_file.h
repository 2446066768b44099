// Stores an unfinished picture in a file, with its identity.
//
// Lines of text: "dmpc checkpoint 4", "name=value" for each fact of the picture, an empty one. Then, in this computer's byte
// order: the number of the pass (8 bytes); a step for each pixel (core::SampleStep, a byte, padded to words of 64 bits); a bit
// for each finished pixel, in words of 64; for each pixel its sums on the film and its samples in finished passes; for a refined
// picture the state of each pixel (core::PixelPast); a digest of everything.
#pragma once

#include <filesystem>

#include "apps/frontend/system/output_file.h"
#include "apps/render/picture_identity.h"
#include "core/picture/film/partial_picture.h"

namespace dmpc::apps {

/// Writes it atomically, and waits until it is on the disk. Requires that no other process does so. Throws core::InputError if
/// that fails.
void write_checkpoint(const std::filesystem::path& path, const PictureIdentity& identity, const core::Film& film,
                      const core::Refinement& pass, const core::PixelMask& done, Files& files = real_files());

/// Throws core::InputError if the file cannot be read, is no checkpoint, is damaged, belongs to another picture (the message
/// names the differences), or describes an impossible state (core::fault_of()). The digest detects accidents only: a forged
/// checkpoint with a possible state, but other light, gives another film.
core::PartialPicture read_checkpoint(const std::filesystem::path& path, const PictureIdentity& identity,
                                     Files& files = real_files());

}  // namespace dmpc::apps
