// What the nodes of any program are busy with, as far as the computer can tell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/trace/charge.h"
#include "nodes/observer.h"

namespace dmpc::apps {

enum class ProgramWork : std::uint8_t {
  computing,
  messages,  ///< sending and taking over packets (modelled machines)
  pages      ///< of tasks: installing pages, and serving them to others
};
inline constexpr std::array<std::string_view, 3> program_work_names = {"computing", "messages", "pages"};
/// Of programs without pages the first two.
inline constexpr std::size_t packet_work_count = 2;

/// For a nodes::ActivityProfile: the number of what a span counts as. `has_pages`: a task's, which are charged for installs.
inline std::size_t program_work_of(const nodes::Span& span, bool has_pages) {
  constexpr auto install = nodes::ChargeBits{1U << static_cast<std::uint32_t>(core::Charge::page_install)};
  const bool is_message = span.activity == nodes::Activity::send || span.activity == nodes::Activity::take_over;
  const bool is_page = has_pages && (span.activity == nodes::Activity::serve || span.charged() == install);
  return static_cast<std::size_t>(is_message ? ProgramWork::messages : is_page ? ProgramWork::pages : ProgramWork::computing);
}

}  // namespace dmpc::apps
