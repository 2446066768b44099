// Pictures by OpenImageIO, from memory.
#pragma once

#include <memory>

#include "apps/foreign/opened_picture.h"

namespace dmpc::apps {

/// Makes the library ready, after which it opens nothing and starts no threads.
void prepare_decoders();

/// Throws core::InputError "NAME: ...". What lies in `picture` outlives what is opened.
std::unique_ptr<OpenedPicture> decode(const EncodedPicture& picture, PictureUse use);

}  // namespace dmpc::apps
