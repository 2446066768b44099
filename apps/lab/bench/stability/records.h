// A memory that loses everything between two looks: what makes a walk stop at each of its records.
#pragma once

#include <cstddef>

#include "core/record/records.h"

namespace dmpc::apps {

/// Says absent the first time that it is asked for a record, and keeps no more than that one record. Not thread-safe.
class OneRecord {
 public:
  explicit OneRecord(std::span<const std::byte> database) : all_(database) {}

  const std::byte* find(core::Address address) {
    if (address != held_) {
      return nullptr;
    }
    held_ = core::no_address;
    return all_.find(address);
  }
  void fetch(core::Address address) { held_ = address; }

 private:
  core::LocalRecords all_;
  core::Address held_ = core::no_address;
};

}  // namespace dmpc::apps
