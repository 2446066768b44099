// A trace with its names.
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
enum class SpanName : std::uint8_t {
  trace,
  shade,
  install_page,
  pack_rays,
  unpack_rays,
  overhead,
  serve_page,
  send,
  take_packet
};
inline constexpr std::array<const char*, 9> span_names = {"trace",    "shade",      "install page", "pack rays",  "unpack rays",
                                                          "overhead", "serve page", "send packets", "take packet"};

/// A recorded trace and the meaning of its numbers. A view.
struct TraceView {
  const nodes::Trace& trace;
  std::span<const char* const> kind_names;  ///< kinds of the strategy's packets
  bool has_pages = false;                   ///< pages travel
  std::uint32_t width = 1;                  ///< width of the picture, in pixels
  std::string clock;                        ///< "virtual time" or "wall clock"
  /// Further named properties of the run, written literally: without line ends.
  std::vector<std::pair<std::string, std::string>> remarks;
  /// By SpanName, for programs whose activities have other names than a renderer's.
  std::span<const char* const> activity_names = span_names;
  /// By Charge, for programs with operations of their own; nullptr: the program does not have this operation.
  std::span<const char* const> operation_names = {};

  /// All names of spans: by SpanName, then by Charge.
  std::vector<const char*> span_texts() const;
  /// Index into span_texts(); a span with the program's own operations has the name of the first of these.
  std::size_t text_number(const nodes::TraceSpan& span) const;
};

/// "node 3", or "host" for the last.
std::string node_name(const TraceView& view, std::size_t index);

SpanName name_of(const nodes::TraceSpan& span);

/// A node's wait for a page, from the request to the reply.
struct PageWait {
  std::uint32_t node = 0, page = 0;
  std::uint64_t begin_ns = 0, end_ns = 0;
};
/// Waits in the order of their ends, without those during which events were dropped. Empty unless pages travel.
std::vector<PageWait> page_waits(const TraceView& view);

struct TraceStretch {
  std::uint64_t begin_ns = 0, end_ns = 0;
};
/// If events were dropped: the stretches without gaps, up to the last event; else empty.
std::vector<TraceStretch> recorded_stretches(const nodes::Trace& trace);
/// End of the last recorded event.
std::uint64_t end_ns(const nodes::Trace& trace);

/// A thousandth of `value`, exactly: "1234.567".
std::string thousandths(std::uint64_t value);
/// Nanoseconds as milliseconds, to the microsecond.
std::string milliseconds(std::uint64_t time_ns);
/// A text about dropped events and what remains. Requires that some were dropped.
std::string lost_text(const nodes::Trace& trace);

}  // namespace dmpc::apps
