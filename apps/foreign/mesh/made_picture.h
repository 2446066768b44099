// A picture that a file holds itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dmpc::apps {

/// Texels, or a picture's file.
struct MadePicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texels;  ///< sRGB, red in the lowest byte
  std::vector<std::byte> file;
  std::string format_hint;  ///< how such files end
};

}  // namespace dmpc::apps
