// A picture that a file holds itself.
#pragma once

#include <cstdint>
#include <vector>

namespace dmpc::apps {

struct MadePicture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texels;  ///< sRGB, red in the lowest byte
};

}  // namespace dmpc::apps
