// What the image viewer tev takes from other programs, packet by packet, as its README and the sources that this names lay it out
// (T. Mueller, https://github.com/Tom94/tev, "Over the Network").
//
// A packet: its length in bytes with these four, a byte for the operation, and what that needs. Numbers are little-endian, whole
// ones of 32 bits but where it says otherwise; texts end with a zero byte; a truth is a byte.
//   create (4)   grab focus, the picture's name, width, height, number of channels, their names
//   update (6)   grab focus, the picture's name, number of channels, their names, x, y, width, height, of each channel where it
//                begins and then how far its values lie apart (64 bits each, in values), the values as floats
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dmpc::apps {

/// A rectangle of a picture.
struct PictureTile {
  std::int32_t x = 0, y = 0;  ///< of its upper left pixel
  std::int32_t width = 0, height = 0;
  std::vector<float> rgb;  ///< linear, row by row
};

/// Makes a black picture with the channels R, G and B, in place of one of the same name, and shows it.
std::string create_packet(const std::string& picture, std::int32_t width, std::int32_t height);

/// Changes a part of it. Requires a tile with pixels, and three values for each.
std::string update_packet(const std::string& picture, const PictureTile& tile);

}  // namespace dmpc::apps
