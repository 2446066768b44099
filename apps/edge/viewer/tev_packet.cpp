#include "apps/edge/viewer/tev_packet.h"

#include <cstring>
#include <span>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

constexpr std::int32_t channel_count = 3;
constexpr const char* channel_names[channel_count] = {"R", "G", "B"};

/// Puts one together; this computer's numbers are little-endian, too.
class Packet {
 public:
  explicit Packet(char operation) : bytes_(sizeof(std::uint32_t), '\0') { bytes_ += operation; }

  template <class Number>
  void put(Number number) {
    put(std::span<const Number>(&number, 1));
  }
  template <class Number>
  void put(std::span<const Number> numbers) {
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
  }
  void put_truth(bool is_true) { bytes_ += is_true ? '\1' : '\0'; }
  void put_text(const std::string& text) { bytes_ += text.substr(0, text.find('\0')) + '\0'; }
  void put_channels() {
    put(channel_count);
    for (const char* const name : channel_names) {
      put_text(name);
    }
  }
  /// With its length in front.
  std::string finish() {
    const auto length = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &length, sizeof(length));
    return bytes_;
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string create_packet(const std::string& picture, std::int32_t width, std::int32_t height) {
  Packet packet(4);
  packet.put_truth(true);
  packet.put_text(picture);
  packet.put(width);
  packet.put(height);
  packet.put_channels();
  return packet.finish();
}

std::string update_packet(const std::string& picture, const PictureTile& tile) {
  core::expect(!tile.rgb.empty() && tile.rgb.size() == std::size_t{3} * static_cast<std::size_t>(tile.width * tile.height),
               "a tile has three values for each pixel");
  Packet packet(6);
  packet.put_truth(false);
  packet.put_text(picture);
  packet.put_channels();
  for (const std::int32_t number : {tile.x, tile.y, tile.width, tile.height}) {
    packet.put(number);
  }
  for (const std::int64_t number : {0, 1, 2, channel_count, channel_count, channel_count}) {
    packet.put(number);
  }
  packet.put(std::span<const float>(tile.rgb));
  return packet.finish();
}

}  // namespace dmpc::apps
