// "Find record r, or say absent": the one thing tracing asks of a node's memory.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "core/record/record.h"

namespace dmpc::core {

/// A source of records. find() returns the record's first byte, readable to the end of its page and for 32 bytes more (kernels
/// load whole vectors), or nullptr if the record is absent. The pointer is valid until the next call.
template <class T>
concept Records = requires(T& records, Address address) {
  { records.find(address) } -> std::same_as<const std::byte*>;
};

/// The whole database in one array: never absent. Compiles to plain loads.
class LocalRecords {
 public:
  explicit LocalRecords(std::span<const std::byte> database) : bytes_(database.data()) {}
  const std::byte* find(Address address) const { return bytes_ + byte_offset(address); }

 private:
  const std::byte* bytes_;
};
static_assert(Records<LocalRecords>);

/// Bytes that must be readable behind the last page of a memory that find() points into.
inline constexpr std::size_t overread_bytes = 32;

}  // namespace dmpc::core
