// A picture under way in a file: whose it is, and what of it is done.
//
// Lines of text: "dmpc checkpoint 4", "name=value" for each fact of the picture, an empty one. Then, in this computer's order of
// bytes: the number of the pass (8 bytes); a step for each pixel (core::SampleStep, a byte, filled up to words of 64 bits); a bit
// for each pixel that is done, in words of 64; for each pixel its sums on the film and its samples of passes that have ended;
// where the picture is refined, what is remembered of each pixel (core::PixelPast); the digest of all that.
#pragma once

#include <filesystem>

#include "apps/frontend/system/output_file.h"
#include "apps/render/picture_identity.h"
#include "core/picture/film/partial_picture.h"

namespace dmpc::apps {

/// Writes it whole, as far as the disk, or leaves what there was. Requires that no other process does so. Throws core::InputError
/// if that fails.
void write_checkpoint(const std::filesystem::path& path, const PictureIdentity& identity, const core::Film& film,
                      const core::Refinement& pass, const core::PixelMask& done, Files& files = real_files());

/// Throws core::InputError if the file cannot be read, is no checkpoint, is damaged, is one of another picture (then it says what
/// differs), or tells of what cannot be (core::fault_of()). The digest tells accidents: whoever forges a checkpoint that could
/// have come about, with other light, gets another film.
core::PartialPicture read_checkpoint(const std::filesystem::path& path, const PictureIdentity& identity,
                                     Files& files = real_files());

}  // namespace dmpc::apps
