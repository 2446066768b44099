// Failures of a rank, for the others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>

#include "nodes/ranks/rank_links.h"

namespace dmpc::nodes {

/// The kind of a failure.
enum class FailureKind : std::uint8_t { internal, room, fabric };

/// A serialised exception.
struct Failure {
  FailureKind kind = FailureKind::internal;
  std::string text;
};

/// The text and kind of an exception.
Failure failure_of(const std::exception_ptr& exception);

/// Throws an exception of this kind: core::CapacityError, FabricError or core::InternalError.
[[noreturn]] void fail_as(FailureKind kind, const std::string& text);

/// Sends it to rank 0, which waits for something else.
void say_failure(RankLinks& links, const Failure& failure);
/// Throws what another rank has sent by say_failure(), with its name.
[[noreturn]] void fail_as_said(const std::string& rank_name, std::span<const std::byte> word);

}  // namespace dmpc::nodes
