// What has failed on a rank, as others hear of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>

#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// What a failure is, for those who hear of it.
enum class FailureKind : std::uint8_t { internal, room, fabric };

/// An exception as it travels.
struct Failure {
  FailureKind kind = FailureKind::internal;
  std::string text;
};

/// What is said of an exception.
Failure failure_of(const std::exception_ptr& exception);

/// Throws what it is of: core::CapacityError, FabricError or core::InternalError.
[[noreturn]] void fail_as(FailureKind kind, const std::string& text);

/// Tells rank 0, which waits for something else.
void say_failure(RankLinks& links, const Failure& failure);
/// Throws what another rank has said by say_failure(), with its name.
[[noreturn]] void fail_as_said(const std::string& rank_name, std::span<const std::byte> word);

}  // namespace dmpc::nodes
