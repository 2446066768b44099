#include "apps/picture/picture_library.h"

#include "apps/system/module.h"

namespace dmpc::apps {

const PictureLibrary& picture_library() {
  static const auto* const library =
      static_cast<const PictureLibrary*>(open_module("pictures", "writes pictures of all kinds but .exr and .png"));
  return *library;
}

}  // namespace dmpc::apps
