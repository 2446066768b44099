// A trace in words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "nodes/observers/trace.h"

namespace dmpc::apps {

/// What a node is doing.
enum class SpanName : std::uint8_t { trace, shade, install_page, pack_rays, unpack_rays, overhead, serve_page, send, take_packet };
inline constexpr std::array<const char*, 9> span_names = {"trace",   "shade",      "install page", "pack rays",  "unpack rays",
                                                          "overhead", "serve page", "send packets", "take packet"};

/// What was recorded, and what its numbers mean. A view.
struct TraceView {
  const nodes::Trace& trace;
  std::span<const char* const> kind_names;  ///< kinds of the strategy's packets
  bool has_pages = false;                   ///< pages travel
  std::uint32_t width = 1;                  ///< width of the picture, in pixels
  std::string clock;                        ///< "virtual time" or "wall clock"
  /// What else there is to say of the run, with its name. Written as it is: without line ends.
  std::vector<std::pair<std::string, std::string>> remarks;
  /// By SpanName, where a program calls its doings otherwise than a renderer.
  std::span<const char* const> activity_names = span_names;
  /// By Charge, of a program that has operations of its own; nullptr: it has not this one.
  std::span<const char* const> operation_names = {};

  /// All that a span may be called: by SpanName, then by Charge.
  std::vector<const char*> span_texts() const;
  /// Which of them: of what does operations of the program's own the first of these.
  std::size_t text_number(const nodes::TraceSpan& span) const;
};

/// "node 3", or "host" for the last.
std::string node_name(const TraceView& view, std::size_t index);

SpanName name_of(const nodes::TraceSpan& span);

/// A node that waits for a page, from the request to the reply.
struct PageWait {
  std::uint32_t node = 0, page = 0;
  std::uint64_t begin_ns = 0, end_ns = 0;
};
/// Waits in the order of their ends, without those during which events were dropped. Empty unless pages travel.
std::vector<PageWait> page_waits(const TraceView& view);

/// From a time to another.
struct TraceStretch {
  std::uint64_t begin_ns = 0, end_ns = 0;
};
/// When all was recorded, if something was forgotten, until the last event; else nothing.
std::vector<TraceStretch> recorded_stretches(const nodes::Trace& trace);
/// When the last thing is over that was recorded.
std::uint64_t end_ns(const nodes::Trace& trace);

/// "1234.567": a thousandth of a number of nanoseconds, without rounding.
std::string thousandths(std::uint64_t value);
/// Nanoseconds as milliseconds, to the microsecond.
std::string milliseconds(std::uint64_t time_ns);
/// What was lost of a trace, and so what is there. Requires that something was.
std::string lost_text(const nodes::Trace& trace);

}  // namespace dmpc::apps
