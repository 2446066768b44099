// PNG, JPEG and EXR without OpenImageIO, as it decodes them.
#pragma once

#include <memory>

#include "apps/foreign/opened_picture.h"

namespace dmpc::apps {

/// Bit-identical to decode() of apps/foreign/picture_decoder.h, except for one alpha of EXR just below half a byte, which
/// decode() rounds to 0 or 1 depending on its place in the row. Returns nothing for a picture that is not plain
/// (apps/foreign/plain_picture.h), or that has alpha by which OpenImageIO would multiply or divide: these, and all errors, are
/// left to OpenImageIO.
std::unique_ptr<OpenedPicture> decode_plain(const EncodedPicture& picture, PictureUse use);

}  // namespace dmpc::apps
