// The events of a file of --trace, and what it says of its messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

namespace dmpc::tests {

/// The fields of an event of Perfetto's track_event.proto that these tests read.
struct TraceEvent {
  enum class Type : std::uint8_t { slice_begin = 1, slice_end, instant, counter };

  std::uint64_t time_ns = 0, track = 0;
  Type type = Type::instant;
  std::uint64_t begins = 0, ends = 0;  ///< the number of a message, if it does
};

/// The fields of a message of Protocol Buffers: each number with a whole number, or with bytes.
class WireFields {
 public:
  explicit WireFields(std::string_view bytes) : rest_(bytes) {}

  bool next() {
    if (rest_.empty()) {
      return false;
    }
    const std::uint64_t tag = take_number();
    field = tag >> 3U;
    const bool is_number = (tag & 7U) == 0, is_fixed = (tag & 7U) == 1;
    number = is_number ? take_number() : 0;
    bytes = is_number ? std::string_view() : rest_.substr(0, is_fixed ? 8 : take_number());
    for (std::size_t i = 0; is_fixed && i < 8; ++i) {
      number |= std::uint64_t{static_cast<unsigned char>(bytes.at(i))} << 8 * i;
    }
    rest_.remove_prefix(bytes.size());
    return true;
  }

  std::uint64_t field = 0, number = 0;
  std::string_view bytes;

 private:
  std::uint64_t take_number() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const auto byte = static_cast<unsigned char>(rest_.at(0));
      rest_.remove_prefix(1);
      value |= std::uint64_t{byte & 127U} << shift;
      if (byte < 128) {
        return value;
      }
    }
  }

  std::string_view rest_;
};

inline std::vector<TraceEvent> trace_events(std::string_view file) {
  std::vector<TraceEvent> events;
  for (WireFields packets(file); packets.next();) {
    TraceEvent event;
    for (WireFields packet(packets.bytes); packet.next();) {
      event.time_ns = packet.field == 8 ? packet.number : event.time_ns;
      for (WireFields fields(packet.field == 11 ? packet.bytes : ""); fields.next();) {
        event.type = fields.field == 9 ? static_cast<TraceEvent::Type>(fields.number) : event.type;
        event.track = fields.field == 11 ? fields.number : event.track;
        event.begins = fields.field == 47 ? fields.number : event.begins;
        event.ends = fields.field == 48 ? fields.number : event.ends;
      }
    }
    if (event.track != 0) {
      events.push_back(event);
    }
  }
  return events;
}

/// Messages whose beginning and end stand in the file, in that order of time.
inline std::size_t messages_in_order(const std::vector<TraceEvent>& events) {
  std::map<std::uint64_t, std::uint64_t> sent_ns;
  std::size_t count = 0;
  for (const TraceEvent& event : events) {
    if (event.begins != 0) {
      sent_ns[event.begins] = event.time_ns;
    } else if (event.ends != 0) {
      const auto sent = sent_ns.find(event.ends);
      count += sent != sent_ns.end() && sent->second <= event.time_ns ? 1 : 0;
    }
  }
  return count;
}

}  // namespace dmpc::tests
