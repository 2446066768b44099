// Messages in the wire format of Protocol Buffers (Google, "Encoding"): fields with number and type of encoding.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dmpc::apps {

/// One message, field by field, in any order. Equal fields give equal bytes.
class WireMessage {
 public:
  /// Unsigned integers, booleans and enumerations, as varints.
  void put(std::uint32_t field, std::uint64_t value);
  /// A number of type fixed64.
  void put_fixed(std::uint32_t field, std::uint64_t value);
  /// A text, or a message within this one.
  void put_bytes(std::uint32_t field, std::string_view bytes);
  void put(std::uint32_t field, const WireMessage& message) { put_bytes(field, message.bytes()); }

  std::string_view bytes() const { return bytes_; }
  void clear() { bytes_.clear(); }

 private:
  void add(std::uint64_t value);

  std::string bytes_;
};

}  // namespace dmpc::apps
