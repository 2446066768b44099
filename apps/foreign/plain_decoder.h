// PNG, JPEG and EXR without OpenImageIO, as it decodes them.
#pragma once

#include <memory>

#include "apps/foreign/opened_picture.h"

namespace dmpc::apps {

/// What decode() of apps/foreign/picture_decoder.h opens, to the last bit, but for one alpha of EXR, just below half a byte, of
/// which it makes 0 or 1 by where it stands in its row; nothing for a picture that is not plain
/// (apps/foreign/plain_picture.h), or one with alpha that OpenImageIO would multiply or divide by: those are left to OpenImageIO,
/// and so are all errors.
std::unique_ptr<OpenedPicture> decode_plain(const EncodedPicture& picture, PictureUse use);

}  // namespace dmpc::apps
