#include "apps/frontend/show/trace/wire.h"

namespace dmpc::apps {

namespace {

/// How a value is written, in the three lowest bits before it.
enum : std::uint64_t { as_number = 0, as_fixed64 = 1, as_bytes = 2 };

constexpr std::uint64_t more = 0x80;

std::uint64_t tag(std::uint32_t field, std::uint64_t how) { return std::uint64_t{field} << 3U | how; }

}  // namespace

void WireMessage::add(std::uint64_t value) {
  for (; value >= more; value >>= 7U) {
    bytes_.push_back(static_cast<char>(value % more | more));
  }
  bytes_.push_back(static_cast<char>(value));
}

void WireMessage::put(std::uint32_t field, std::uint64_t value) {
  add(tag(field, as_number));
  add(value);
}

void WireMessage::put_fixed(std::uint32_t field, std::uint64_t value) {
  add(tag(field, as_fixed64));
  for (int i = 0; i < 8; ++i, value >>= 8U) {
    bytes_.push_back(static_cast<char>(value & 0xffU));
  }
}

void WireMessage::put_bytes(std::uint32_t field, std::string_view bytes) {
  add(tag(field, as_bytes));
  add(bytes.size());
  bytes_.append(bytes);
}

}  // namespace dmpc::apps
