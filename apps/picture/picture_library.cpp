#include "apps/picture/picture_library.h"

#include <cstddef>

#include "apps/edge/system/module.h"

namespace dmpc::apps {

namespace {

/// A library that OpenImageIO brings (log4cplus) starts four threads as it is loaded, and now and then waits for ever if it
/// cannot start them all. So as many and some more must be had at one time before.
constexpr std::size_t threads_at_once = 8;

}  // namespace

const PictureLibrary& picture_library() {
  static const auto* const library = static_cast<const PictureLibrary*>(
      open_module("pictures", "writes pictures of all kinds but .exr and .png", threads_at_once));
  return *library;
}

}  // namespace dmpc::apps
