// The formats in which a trace is written, by the endings of files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "apps/edge/show/trace/view.h"

namespace dmpc::apps {

enum class TraceFormat : std::uint8_t {
  chrome,    ///< .json: Chrome's events, which Perfetto reads, too
  perfetto,  ///< .pftrace: Perfetto's own
  paje       ///< .paje
};

struct TraceFile {
  TraceFormat format = TraceFormat::chrome;
  bool is_packed = false;  ///< by gzip: .gz behind it
};

/// Nothing for any other ending.
std::optional<TraceFile> trace_file_of(const std::filesystem::path& path);

/// Not packed.
void write_trace(const TraceView& view, TraceFormat format, std::ostream& output);

}  // namespace dmpc::apps
