// Conclusions from the figures of a render: a sentence or two for each section of its page, empty if there is nothing to say.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "apps/run/report.h"
#include "apps/show/heat/field.h"

namespace dmpc::apps::html {

/// `rays`: from a node (row) to an owner (column); `shot`: all rays.
std::string ray_conclusion(std::span<const std::uint64_t> rays, std::uint64_t shot);
std::string node_conclusion(const Account& account);
std::string memory_conclusion(const Account& account, std::size_t database_bytes);
/// Returns the conclusion from the fields that add up over pixels.
std::string heat_conclusion(const HeatField& field);

}  // namespace dmpc::apps::html
