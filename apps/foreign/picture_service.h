// What a program does that decodes pictures for dmpc, whichever library it has.
#pragma once

#include <functional>
#include <memory>

#include "apps/foreign/opened_picture.h"

namespace dmpc::apps {

/// Opens a picture, or gives nothing for one that is left to another program. Throws core::InputError "NAME: ...".
using PictureDecoder = std::function<std::unique_ptr<OpenedPicture>(const EncodedPicture& picture, PictureUse use)>;

/// As apps/foreign/service.h says: never returns.
[[noreturn]] void serve_pictures(const PictureDecoder& decode);

}  // namespace dmpc::apps
